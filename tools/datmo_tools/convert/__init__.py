# SPDX-License-Identifier: BSD-3-Clause
"""Converts recordings from other sources to bags for the stack."""
