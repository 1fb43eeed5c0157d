# SPDX-License-Identifier: BSD-3-Clause
"""Runs a folder of recordings through the stack, and writes one report on all of them."""
