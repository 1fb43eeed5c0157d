# SPDX-License-Identifier: BSD-3-Clause
"""Compares the figures of many runs, side by side."""
