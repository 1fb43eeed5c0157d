# SPDX-License-Identifier: BSD-3-Clause
"""Plots SourceTallies: what each source detects by range, and its false tracks."""

import numpy as np

from datmo_tools.evaluate.plot_style import picture, plain, series_color
from datmo_tools.evaluate.source_tally import CLASSES

MARKERS = ("o", "s", "^")
MIN_FRAMES = 20  # of a point: its share is known to 0.1


def source_plot(tallies, kind):
    """Returns the bytes of the picture.

    tallies: dictionary name -> SourceTally; kind: of plot_style.KINDS.
    """

    def draw(axes):
        for color, (name, tally) in enumerate(tallies.items()):
            _draw_detection(axes[0], name, tally, series_color(color))
            _draw_false(axes[1], name, tally, series_color(color))
        title = "Share of the frames in which it has a track of what it could see; lines: the law"
        axes[0].set_title(title, loc="left")
        axes[0].set_ylim(0.0, 1.3)
        axes[1].set_title("Frames of false tracks a minute", loc="left")
        axes[1].set_xlabel("range (m)")
        for ax in axes:
            ax.legend(loc="upper right", ncol=2)

    return picture(kind, 6.0, draw, nrows=2, sharex=True)


def _draw_detection(ax, name, tally, color):
    for marker, of_class in zip(MARKERS, CLASSES.values()):
        shares = [(tally.center(i), tally.detection(of_class, i)) for i in range(tally.bins)]
        points = [(center, share) for center, share in shares if share.whole >= MIN_FRAMES]
        # The standard deviation of a share p of n frames is sqrt(p (1 - p) / n).
        errors = [(share.value * (1.0 - share.value) / share.whole) ** 0.5 for _, share in points]
        if points:
            centers = np.linspace(points[0][0], points[-1][0], 100)
            ax.plot(centers, tally.law(of_class).at(centers), color=color, linewidth=0.7)
        ax.errorbar([center for center, _ in points], [share.value for _, share in points], errors,
                    fmt=marker, color=color, label=plain(f"{name}, {of_class}"))  # fmt: skip


def _draw_false(ax, name, tally, color):
    bins = range(tally.bins)
    ax.plot([tally.center(i) for i in bins], [tally.false_per_minute(i) for i in bins],
            marker="o", color=color, label=plain(name))  # fmt: skip
