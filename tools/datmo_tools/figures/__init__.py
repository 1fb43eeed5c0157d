# SPDX-License-Identifier: BSD-3-Clause
"""The figures of README.md and doc/results.md: measured by scripts/figures, stored in
doc/results.json, and rendered from it."""
