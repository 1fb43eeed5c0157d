# SPDX-License-Identifier: BSD-3-Clause
"""Python side of the tools: converters to bags of the stack's data contract."""
