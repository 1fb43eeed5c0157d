# SPDX-License-Identifier: BSD-3-Clause
"""Draws the reliability diagram of evaluate risk."""

from datmo_tools.evaluate.plot_style import FAINT, TRUTH, drawing, plain, series_color

HEIGHT = 3.2  # inch
LARGEST = 120.0  # points^2, area of the marker of a bin with all frames
SMALLEST = 8.0  # points^2, that still is seen


def reliability_drawing(result):
    """Returns an SVG element: observed frequency over predicted probability, an axis for each time,
    a curve for each method.

    result: scores (dict) by method, as risk_scores.score returns them.
    """
    horizons = list(next(iter(result.values()))["horizons"])

    def draw(axes):
        for ax, horizon in zip(axes[0], horizons):
            ax.plot([0.0, 100.0], [0.0, 100.0], color=TRUTH, linestyle="--", label="calibrated")
            for i, (name, item) in enumerate(result.items()):
                _draw_method(ax, item["horizons"][horizon]["reliability"], series_color(i), name)
            ax.set_title(f"contact within {horizon} s", loc="left")
            ax.set(xlabel="predicted (%)", xlim=(-5.0, 105.0), ylim=(-5.0, 105.0))
        axes[0][0].set_ylabel("observed (%)")
        axes[0][0].legend(frameon=True, edgecolor=FAINT)

    return drawing(HEIGHT, draw, ncols=len(horizons), sharey=True, squeeze=False)


def _draw_method(ax, bins, color, name):
    """The area of a marker grows with the bin's share of frames: a bin with few proves little."""
    predicted = [100.0 * each[0] for each in bins]
    observed = [100.0 * each[1] for each in bins]
    counts = [each[2] for each in bins]
    areas = [max(SMALLEST, LARGEST * count / sum(counts)) for count in counts]
    ax.plot(predicted, observed, color=color, label=plain(name))
    ax.scatter(predicted, observed, s=areas, color=color)
