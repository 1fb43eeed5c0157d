# SPDX-License-Identifier: BSD-3-Clause
"""The error that a tool shows its user instead of a traceback."""


class InputError(Exception):
    """An unusable file or value: which one, its state, and what was expected."""
