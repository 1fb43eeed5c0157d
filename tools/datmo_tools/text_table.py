# SPDX-License-Identifier: BSD-3-Clause
"""Tables as text."""

from tabulate import tabulate

NO_VALUE = "-"  # for what was not measured


def aligned(rows):
    """Returns rows of cells as aligned columns, the first one left-aligned; empty rows are dropped.
    """
    rows = [row for row in rows if any(row)]
    alignment = ("left", *["right"] * (len(rows[0]) - 1))
    return tabulate(rows, tablefmt="plain", colalign=alignment, disable_numparse=True)


def rounded(value, digits):
    """Formats a number; NO_VALUE for None."""
    return NO_VALUE if value is None else f"{value:.{digits}f}"


def spread_text(values, digits=0, scale=1.0):
    """Formats [median, min, max] as `median (min to max)`, or as the median alone if the rounded
    values are equal; NO_VALUE for None."""
    if values is None:
        return NO_VALUE
    median, lowest, highest = (f"{value * scale:.{digits}f}" for value in values)
    return median if lowest == highest else f"{median} ({lowest} to {highest})"


def percent(share, digits=1):
    """Formats a share as percent; NO_VALUE for None."""
    return NO_VALUE if share is None else f"{100.0 * share:.{digits}f}"


def one_line(text):
    """Returns text of unknown origin, as names from a bag, for a line: control characters as their
    escapes, so that it neither ends the line nor controls the terminal."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
