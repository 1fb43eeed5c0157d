# SPDX-License-Identifier: BSD-3-Clause
"""Draws a moment of a run from above, with the vehicle at the origin and driving to the right."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from datmo_fusion.msg import RoadBorder, ScanPoint
from datmo_tools import transforms
from datmo_tools.evaluate.border_lists import SIDES
from datmo_tools.evaluate.border_recordings import edge
from datmo_tools.evaluate.plot_style import COLORS, FALSE, INK, TRUTH
from datmo_tools.stamps import NANOSECONDS

BEHIND, AHEAD, ASIDE = 16.0, 46.0, 20.0  # m, shown area
TICKS = 10.0  # m
AHEAD_NAME, LEFT_NAME = "ahead (m)", "to the left (m)"
SHAPE = 2.0 * ASIDE / (BEHIND + AHEAD)  # height over width

LEFT, RIGHT, MOVING = COLORS[0], COLORS[1], COLORS[2]
SHADES = {SIDES[RoadBorder.LEFT]: LEFT, SIDES[RoadBorder.RIGHT]: RIGHT}
STATES = {ScanPoint.STATIC: "#0f172a", ScanPoint.MOVING: COLORS[5], ScanPoint.UNKNOWN: COLORS[4]}

EARLIER = "#a16207"

SIGMAS = 2.0  # shown on either side of a border
BAND = 0.25  # opacity of that band
FAINTEST = 0.2  # opacity of a border with probability 0, so that it remains visible
LONG_UNSEEN = 1.0  # s: a border that no scan has observed for longer is dashed

RING = {"markersize": 7.0, "markerfacecolor": "none", "markeredgewidth": 0.9}

VEHICLE = np.array([(4.2, 0.0), (-0.8, 0.9), (-0.8, -0.9)])  # m: an arrow, not its true outline


def opacity(border):
    """Returns the opacity, 0 to 1, by the border's probability."""
    return FAINTEST + (1.0 - FAINTEST) * float(np.clip(border.probability, 0.0, 1.0))


def line_style(border):
    """Returns the style: dashed if not observed for long, dotted for a side street, else solid."""
    if border.side_street:
        return ":"
    return "--" if border.unseen > LONG_UNSEEN else "-"


def draw_view(ax, moment):
    """Draws a Moment into the axes."""
    if moment.truth is not None:
        for box in moment.truth.boxes:
            ax.fill(*box.T, color=TRUTH, alpha=0.35, linewidth=0.0)
        for line in moment.truth.borders:
            ax.plot(*line.T, color=TRUTH, linewidth=3.5, alpha=0.8, solid_capstyle="butt")
    ax.plot(*moment.earlier.T, ".", color=EARLIER, markersize=1.6, markeredgewidth=0.0)
    for border in moment.borders:
        _draw_border(ax, moment.base, border)
    ax.fill(*VEHICLE.T, color=INK)
    _draw_boxes(ax, moment.others, TRUTH)
    _draw_boxes(ax, moment.moving, MOVING)
    _draw_boxes(ax, moment.dropped, FALSE)
    for state, shade in STATES.items():
        ax.plot(*moment.points[moment.states == state].T, ".", color=shade, markersize=3.2,
                markeredgewidth=0.0)  # fmt: skip
    _finish(ax)


def title(moment):
    """Returns the time and whether the vehicle is at an intersection."""
    stamp = f"{moment.stamp // NANOSECONDS}.{moment.stamp % NANOSECONDS // 10**7:02d}"
    found = "at an intersection" if moment.at_intersection else "no intersection"
    text = f"{moment.time:.2f} s ({stamp}), {found} ({moment.intersection_probability:.2f})"
    known = None if moment.truth is None else moment.truth.at_intersection
    return text if known is None or known == moment.at_intersection else text + ", WRONG"


def legend_handles(with_truth):
    """Returns one handle for each kind of object that is drawn."""
    def line(shade, label, **style):
        return Line2D([], [], color=shade, label=label, **style)

    dots = {"linestyle": "", "marker": ".", "markersize": 5.0}
    ring = {"linestyle": "", "marker": "o", **RING}
    handles = [
        line(LEFT, "left border"),
        line(RIGHT, f"right border, ± {SIGMAS:g} sigma"),
        line(INK, f"unseen for {LONG_UNSEEN:g} s", linestyle="--"),
        line(INK, "of a side street", linestyle=":"),
        line(STATES[ScanPoint.STATIC], "static point", **dots),
        line(STATES[ScanPoint.MOVING], "moving", **dots),
        line(STATES[ScanPoint.UNKNOWN], "unknown", **dots),
        line(EARLIER, "earlier point", **dots),
        line(MOVING, "moving object", **ring),
        line(TRUTH, "other object", **ring),
        line(FALSE, "dropped object", **ring),
    ]
    if with_truth:
        handles.append(line(TRUTH, "true curb", linewidth=3.5))
        handles.append(Patch(color=TRUTH, alpha=0.35, linewidth=0.0, label="true object"))
    return handles


def _draw_border(ax, base, border):
    left, right = (
        transforms.points_seen_from(base, edge(border, sigmas)) for sigmas in (SIGMAS, -SIGMAS)
    )
    shade, alpha = SHADES[border.side], opacity(border)
    ax.fill(*np.concatenate([left, right[::-1]]).T, color=shade, alpha=BAND * alpha, linewidth=0.0)
    line = transforms.points_seen_from(base, border.points)
    ax.plot(*line.T, color=shade, alpha=alpha, linestyle=line_style(border))
    # The ends of stretches distinguish side streets from gaps.
    ax.plot(*line[[0, -1]].T, "|", color=shade, alpha=alpha, markersize=5.0)


def _draw_boxes(ax, boxes, shade):
    """Draws boxes with a ring around each: many objects are a few points in a line, or one."""
    for box in boxes:
        ax.plot(*np.concatenate([box, box[:1]]).T, color=shade, linewidth=0.9)
        ax.plot(*box.mean(axis=0), "o", color=shade, **RING)


def _finish(ax):
    ax.set_aspect("equal")
    ax.set(xlim=(-BEHIND, AHEAD), ylim=(-ASIDE, ASIDE))
    ax.set_xticks(np.arange(-10.0, AHEAD, TICKS))
    ax.set_yticks(np.arange(-ASIDE, ASIDE + 1.0, TICKS))
