# SPDX-License-Identifier: BSD-3-Clause
"""The figures of README.md and doc/results.md: made by scripts/figures, kept in doc/results.json, rendered from it."""
