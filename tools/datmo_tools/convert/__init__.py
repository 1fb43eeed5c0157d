# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of other sources become bags of the stack."""
