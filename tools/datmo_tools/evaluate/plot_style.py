# SPDX-License-Identifier: BSD-3-Clause
"""The style of evaluate's plots, and the conversion of a figure to text for a page.

Needs matplotlib; nothing in evaluate except plots does.
"""

import io
import re

import matplotlib
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

WIDTH = 10.0  # inch
DPI = 150  # of a picture in pixels
RIGHT, BOTTOM = 0.2, 0.5  # inch: margins of every figure
BETWEEN_ROWS = 0.4  # of a row's height, unless a picture sets it

# Metadata of files, with their time of creation.
KINDS = {"svg": ("Date",), "pdf": ("CreationDate",), "png": ()}

INK = "#1f2937"
FAINT = "#cbd5e1"
TRUTH = "#94a3b8"
MISSED = "#fca5a5"
FALSE = "#dc2626"
COLORS = ("#2563eb", "#ea580c", "#059669", "#9333ea", "#0891b2", "#db2777", "#854d0e", "#475569")

# Text stays text, so that it gets the page's font. A fixed salt: equal input gives equal bytes.
STYLE = {
    "svg.fonttype": "none",
    "svg.hashsalt": "datmo_fusion",
    "font.size": 9.0,
    "text.color": INK,
    "axes.edgecolor": FAINT,
    "axes.labelcolor": INK,
    "axes.titlesize": 9.5,
    "axes.titleweight": "bold",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#e5e7eb",
    "grid.linewidth": 0.6,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.major.size": 0.0,
    "ytick.major.size": 0.0,
    "lines.linewidth": 1.3,
    "legend.frameon": False,
    "legend.fontsize": 9.0,
}


def series_color(index):
    """Returns the color of the run, or of an object's track, with this index; they repeat."""
    return COLORS[index % len(COLORS)]


def plain(text):
    """Returns text that matplotlib does not parse as a formula, and that a legend does not drop."""
    text = str(text).replace("$", r"\$")
    return " " + text if text.startswith("_") else text


def drawing(height, draw, left=0.75, top=0.3, **subplots):
    """Returns the SVG element of one figure.

    height: of the figure; left, top: its margins, inch; draw: function that is called with the
    figure's axes as Figure.subplots(**subplots) returns them.
    """
    with matplotlib.rc_context(STYLE):
        return _element(_figure(height, draw, left, top, BETWEEN_ROWS, subplots))


def picture(kind, height, draw, left=0.75, top=0.3, between=BETWEEN_ROWS, **subplots):
    """Returns the bytes of a file of one figure; equal input gives equal bytes.

    kind: of KINDS; between: gap of two rows, of a row's height; the rest as in drawing().
    """
    data = io.BytesIO()
    with matplotlib.rc_context(STYLE):
        figure = _figure(height, draw, left, top, between, subplots)
        figure.savefig(data, format=kind, dpi=DPI, metadata={key: None for key in KINDS[kind]})
    return data.getvalue()


def _figure(height, draw, left, top, between, subplots):
    figure = Figure(figsize=(WIDTH, height))
    FigureCanvasSVG(figure)
    draw(figure.subplots(**subplots))
    figure.subplots_adjust(
        left=left / WIDTH,
        right=1.0 - RIGHT / WIDTH,
        bottom=BOTTOM / height,
        top=1.0 - top / height,
        hspace=between,
    )
    return figure


def _element(figure):
    """Returns only the <svg>, as wide as its column on the page, without what only a file needs."""
    text = io.StringIO()
    figure.savefig(text, format="svg", transparent=True)
    head, body = re.search(r"(<svg[^>]*>)(.*)", text.getvalue(), re.DOTALL).groups()
    head = re.sub(r' (width|height)="[^"]*"', "", head)
    body = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->", "", body, flags=re.DOTALL)
    # matplotlib numbers its groups; the numbers of two figures on one page would collide.
    return head + re.sub(r' id="[A-Za-z.]+_\d+"', "", body)
