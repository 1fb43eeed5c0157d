"""Tables as text."""

NO_VALUE = "-"  # of what was not measured


def aligned(rows):
    """Rows of cells, the first one headings, as columns that line up."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    lines = ["  ".join(f"{cell:>{width}}" for cell, width in zip(row, widths)) for row in rows]
    return "\n".join(lines)


def rounded(value, digits):
    """A number, or NO_VALUE for None."""
    return NO_VALUE if value is None else f"{value:.{digits}f}"


def percent(share, digits=1):
    """A share as percent, or NO_VALUE for None."""
    return NO_VALUE if share is None else f"{100.0 * share:.{digits}f}"
