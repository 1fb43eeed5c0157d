# SPDX-License-Identifier: BSD-3-Clause
"""Writes reports in one form: sections, as text for a terminal and as a self-contained page."""

import json
from pathlib import Path
from typing import NamedTuple

import jinja2

from datmo_tools.text_table import aligned, one_line
from datmo_tools.whole_files import write_whole

TEMPLATE = "report.html"  # next to this file
BEST = "*"  # suffix of the best cell in its row
MISSED = "MISSED"  # the last cell of a row for what was not found


class Picture(NamedTuple):
    """A picture for a page, with what it shows."""

    url: str  # of the picture, with its data
    caption: str


class Section(NamedTuple):
    """A part of a report. A page shows all of it, a terminal rows and lines."""

    title: str = ""
    hint: str = ""  # what it shows, for a page
    rows: tuple = ()  # of cells (text), the first row headings
    lines: tuple = ()  # of text
    tiles: tuple = ()  # of (name, figure, unit): for a page
    picture: str = ""  # an <svg> element: for a page
    pictures: tuple = ()  # of Picture: for a page
    is_narrow: bool = False  # a page has room for two side by side
    for_page: bool = False  # only


def as_text(sections):
    """Formats sections for a terminal."""
    blocks = []
    for section in sections:
        if (section.rows or section.lines) and not section.for_page:
            rows = [[one_line(str(cell)) for cell in row] for row in section.rows]
            table = [aligned(rows)] if rows else []
            lines = map(one_line, section.lines)
            blocks.append("\n".join([*filter(None, [section.title]), *table, *lines]))
    return "\n\n".join(blocks)


def as_page(title, sections):
    """HTML."""
    loader = jinja2.FileSystemLoader(str(Path(__file__).parent))
    environment = jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)  # fmt: skip
    template = environment.get_template(TEMPLATE)
    return template.render(title=title, sections=sections, best=BEST, missed=MISSED)


def write(folder, name, title, result, sections):
    """Writes `name`.json, the result (dict), and `name`.html to the folder (Path), both or none."""
    page = as_page(title, sections)
    write_whole(folder, {f"{name}.json": json.dumps(result) + "\n", f"{name}.html": page})
