# SPDX-License-Identifier: BSD-3-Clause
"""check_bag: what a recording holds, what is wrong with it, and the configuration to start with."""
