# SPDX-License-Identifier: BSD-3-Clause
"""A folder of recordings through the stack, one report over all."""
