# SPDX-License-Identifier: BSD-3-Clause
"""What the stack computed against what was true."""
