"""How the plots of evaluate look, and how a figure becomes text for a page.

Needs matplotlib; nothing else of evaluate does but the plots.
"""

import io
import re

import matplotlib
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

WIDTH = 10.0  # inch
DPI = 150  # of a picture in pixels
RIGHT, BOTTOM = 0.2, 0.5  # inch: margins of every figure
BETWEEN_ROWS = 0.4  # of a row's height, where a picture does not say

# Of files, and of their time of creation.
KINDS = {"svg": ("Date",), "pdf": ("CreationDate",), "png": ()}

INK = "#1f2937"
FAINT = "#cbd5e1"
TRUTH = "#94a3b8"
MISSED = "#fca5a5"
FALSE = "#dc2626"
COLORS = ("#2563eb", "#ea580c", "#059669", "#9333ea", "#0891b2", "#db2777", "#854d0e", "#475569")

# Texts stay texts, so that the page's font is theirs. A fixed salt: the same input, the same bytes.
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
    """Color of the run, or of an object's track, with this index; they repeat."""
    return COLORS[index % len(COLORS)]


def plain(text):
    """Text in which matplotlib finds no formula, and that a legend does not leave out."""
    text = str(text).replace("$", r"\$")
    return " " + text if text.startswith("_") else text


def drawing(height, draw, left=0.75, top=0.3, **subplots):
    """SVG element of one figure.

    height: of the figure; left, top: its margins, inch; draw: function that is given the
    figure's axes as Figure.subplots(**subplots) returns them.
    """
    with matplotlib.rc_context(STYLE):
        return _element(_figure(height, draw, left, top, BETWEEN_ROWS, subplots))


def picture(kind, height, draw, left=0.75, top=0.3, between=BETWEEN_ROWS, **subplots):
    """Bytes of a file of one figure, the same for the same input.

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
    """The <svg> alone, as wide as its column on the page, without what only a file needs."""
    text = io.StringIO()
    figure.savefig(text, format="svg", transparent=True)
    head, body = re.search(r"(<svg[^>]*>)(.*)", text.getvalue(), re.DOTALL).groups()
    head = re.sub(r' (width|height)="[^"]*"', "", head)
    body = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->", "", body, flags=re.DOTALL)
    # matplotlib numbers its groups; the numbers of two figures on one page would clash.
    return head + re.sub(r' id="[A-Za-z.]+_\d+"', "", body)


PAGE_STYLE = """
body { margin: 0; background: #f8fafc; color: #1f2937;
  font: 15px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 24px 20px 60px; }
h1 { font-size: 26px; margin: 8px 0 4px; }
h2 { font-size: 18px; margin: 0 0 4px; }
h3 { font-size: 15px; margin: 0; }
section { background: #fff; border: 1px solid #e5e7eb; border-radius: 10px; padding: 18px 22px;
  margin: 16px 0; overflow-x: auto; }
section > p { margin: 0 0 10px; color: #64748b; max-width: 80ch; }
svg { width: 100%; height: auto; display: block; }
svg text { font-family: inherit !important; }
.runs { list-style: none; padding: 0; margin: 0 0 12px; color: #475569; }
.dot { display: inline-block; width: 10px; height: 10px; border-radius: 5px; margin-right: 8px; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(130px, 1fr)); gap: 10px; }
.tiles div { background: #fff; border: 1px solid #e5e7eb; border-radius: 10px; padding: 12px 14px; }
.tiles b { display: block; font-size: 22px; line-height: 1.2; }
.tiles span, small, .unit { color: #64748b; font-weight: normal; font-size: 13px; }
.columns, .wide { columns: 2; column-gap: 44px; }
.wide { columns: 1; }
.columns > div, .wide > div { break-inside: avoid; padding-bottom: 20px; }
table { border-collapse: collapse; width: 100%; font-size: 14px;
  font-variant-numeric: tabular-nums; }
td, th { padding: 3px 0 3px 10px; text-align: right; border-bottom: 1px solid #f1f5f9; }
td:first-child, th:first-child { text-align: left; padding-left: 0; }
th { font-weight: 600; }
.metrics th:first-child { color: #64748b; font-weight: normal; font-size: 13px; }
.metrics .unit { width: 62px; text-align: left; }
.metrics .value, .metrics .best { width: 76px; }
.metrics .best { font-weight: 700; color: #047857; background: #ecfdf5; }
.objects td:nth-child(-n+3), .objects th:nth-child(-n+3) { text-align: left; }
.objects td:last-child { max-width: 180px; }
.standing { width: auto; }
.standing td, .standing th { padding-right: 24px; }
.missed { background: #fef2f2; color: #b91c1c; }
.options { width: auto; }
.options td { padding-right: 30px; text-align: left; }
@media (max-width: 800px) { .columns { columns: 1; } }
@media print { section { break-inside: avoid; } }
"""
