# SPDX-License-Identifier: BSD-3-Clause
"""Renders README's table of results and doc/results.md from the file of figures."""

import math
from pathlib import Path

import jinja2

from datmo_tools.errors import InputError
from datmo_tools.text_table import NO_VALUE, spread_text

BEGIN, END = "<!-- figures: begin -->", "<!-- figures: end -->"  # in README.md
README, PAGE = "README.md", "doc/results.md"  # below the root of the sources
FILE = "doc/results.json"


def rendered(source, results):
    """Returns a dictionary name below the root of the sources (Path) -> text with the figures.

    Raises InputError if README.md has no lines for its table.
    """
    values = {"commit": results["commit"], "date": results["date"], "machine": results["machine"],
              "steps": results["steps"]}  # fmt: skip
    readme = (source / README).read_text(encoding="utf-8")
    head, begin, rest = readme.partition(BEGIN)
    _, end, tail = rest.partition(END)
    if not begin or not end:
        raise InputError(f"{source / README}: no lines {BEGIN} and {END}, expected the table there")
    table, page = (_render(name, values) for name in ("readme_table.md.jinja", "results.md.jinja"))
    return {README: f"{head}{begin}\n{table}\n{end}{tail}", PAGE: page + "\n"}


def _render(template, values):
    lines = _environment().get_template(template).render(values).splitlines()
    return "\n".join(line.rstrip() for line in lines)


def _environment():
    loader = jinja2.FileSystemLoader(str(Path(__file__).parent))
    environment = jinja2.Environment(loader=loader, trim_blocks=True, lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined, autoescape=False,
                                     keep_trailing_newline=False)  # fmt: skip
    environment.filters.update(number=number, percent=percent, spread=spread_text, degrees=degrees,
                               percent_spread=percent_spread)  # fmt: skip
    return environment


def number(value, digits=0):
    """Formats with this many digits after the decimal point; "-" if nothing was measured."""
    return NO_VALUE if value is None else f"{value:.{digits}f}"


def percent(share, digits=0):
    """Converts a share to percent."""
    return number(None if share is None else 100.0 * share, digits)


def degrees(angle, digits=1):
    """Converts an angle from rad to degrees."""
    return number(None if angle is None else math.degrees(angle), digits)


def percent_spread(values, digits=0):
    """Formats the same for shares, in percent."""
    return spread_text(values, digits, 100.0)
