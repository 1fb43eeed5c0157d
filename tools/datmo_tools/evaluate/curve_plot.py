# SPDX-License-Identifier: BSD-3-Clause
"""Draws the picture of evaluate operating_curve."""

from datmo_tools.evaluate.metrics import short_names
from datmo_tools.evaluate.plot_style import FAINT, INK, drawing, picture, plain, series_color

HEIGHT = 5.0  # inch


def curve_drawing(result):
    """Returns an SVG element, for a page."""
    return drawing(HEIGHT, lambda ax: _draw(ax, result))


def curve_picture(result):
    """Returns the bytes of a png."""
    return picture("png", HEIGHT, lambda ax: _draw(ax, result))


def _draw(ax, result):
    points = result["points"]
    names = short_names([drive["drive"] for drive in points[0]["drives"]])
    for i, name in enumerate(names):
        of_drive = [point["drives"][i] for point in points]
        ax.plot(*_line(of_drive), color=series_color(i), alpha=0.5, marker=".",
                label=plain(name))  # fmt: skip
    ax.plot(*_line(points), color=INK, linewidth=2.0, marker="o", label="all")
    for point in points:
        x, y = _line([point])
        if x:
            ax.annotate(f"{point['probability']:g}", (x[0], y[0]), xytext=(4, 4),
                        textcoords="offset points")  # fmt: skip
    shipped = [point for point in points if point["probability"] == result["shipped"]]
    ax.plot(*_line(shipped), linestyle="none", marker="o", markersize=12, markerfacecolor="none",
            markeredgecolor=INK, label="shipped")  # fmt: skip
    ax.set(xlabel="false tracks a minute", ylabel="missed frames (%)", ylim=(0.0, None))
    ax.legend(edgecolor=FAINT)


def _line(points):
    """Returns x and y of the points that have both."""
    known = [
        (point["false_tracks_per_minute"], 100.0 * point["missed_share"])
        for point in points
        if None not in (point["false_tracks_per_minute"], point["missed_share"])
    ]
    return [x for x, _ in known], [y for _, y in known]
