# SPDX-License-Identifier: BSD-3-Clause
"""The error that a tool shows to its user instead of a traceback."""


class InputError(Exception):
    """A file or a value that cannot be used: which, its state, and what was expected."""
