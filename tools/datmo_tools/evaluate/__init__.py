# SPDX-License-Identifier: BSD-3-Clause
"""Compares the results of the stack with the ground truth."""
