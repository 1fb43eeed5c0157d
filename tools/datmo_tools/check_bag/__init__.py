# SPDX-License-Identifier: BSD-3-Clause
"""check_bag: what a recording contains, what is wrong with it, and an initial configuration."""
