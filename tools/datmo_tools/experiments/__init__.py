# SPDX-License-Identifier: BSD-3-Clause
"""Many runs, their figures side by side."""
