# SPDX-License-Identifier: BSD-3-Clause
"""Plots over time and over thresholds for evaluate, of one run or of several in one picture.

Each function returns an SVG element. names: of the runs, for the legends.
"""

import numpy as np
from matplotlib.ticker import FuncFormatter

from datmo_tools.evaluate.plot_style import FALSE, INK, MISSED, TRUTH, series_color, drawing, plain

ROW = 0.32  # inch, of a plot with a row for each item
NAMES_WIDTH = 2.4  # inch, for the names of the rows
FLAT = 0.1  # inch, the upper margin without a title


def errors_over_time(runs, names):
    """Plots mean position and velocity error of the matched tracks, and GOSPA, frame by frame."""
    rows = (
        ("position_error_m", "Error of position, mean of the matched tracks", "m"),
        ("velocity_error_mps", "Error of velocity, mean of the matched tracks", "m/s"),
        ("gospa_m", "GOSPA", "m"),
    )

    def draw(axes):
        for ax, (key, title, unit) in zip(axes, rows):
            _plot_series(ax, runs, names, key)
            _finish(ax, title, unit, runs)
        axes[-1].set_xlabel("time (s)")
        _legend_of_runs(axes[0], runs)

    return drawing(5.6, draw, nrows=len(rows), sharex=True)


def counts_over_time(run):
    """Plots the true objects that count, how many are tracked, and, downwards, false tracks."""

    def draw(ax):
        series = run["series"]
        times, false = _numbers(series["time_s"]), _numbers(series["false"])
        tracked, missed = _numbers(series["tracked"]), _numbers(series["missed"])
        fill = {"step": "post", "linewidth": 0.0}
        ax.fill_between(times, 0.0, tracked, color=series_color(0), label="tracked", **fill)
        ax.fill_between(times, tracked, tracked + missed, color=MISSED, label="missed", **fill)
        ax.fill_between(times, -false, 0.0, color=FALSE, label="false tracks", **fill)
        ax.axhline(0.0, color=INK, linewidth=0.8)
        ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{abs(value):g}"))
        _finish(ax, "True objects upwards, false tracks downwards", "number", [run])
        ax.set_xlabel("time (s)")
        ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.0, ncol=3)

    return drawing(2.6, draw)


def hota_over_alpha(runs, names):
    """Plots HOTA at each localization threshold alpha; its mean is the HOTA of the table."""

    def draw(ax):
        for i, (run, name) in enumerate(zip(runs, names)):
            hota = run["hota"]
            values = 100.0 * _numbers(hota["hota_alpha"])
            mean = "-" if hota["hota"] is None else f"{100.0 * hota['hota']:.1f} %"
            label = f"{plain(name)}: mean {mean}"
            alphas = _numbers(hota["alphas"])[: len(values)]  # no values if nothing was scored
            ax.plot(alphas, values, "o-", color=series_color(i), ms=3.5, label=label)
        ax.set(xlim=(0.0, 1.0), ylim=(0.0, 100.0), ylabel="HOTA (%)")
        ax.set_xlabel("alpha: similarity that is asked of a match")
        ax.legend(loc="lower left")

    return drawing(2.8, draw, top=FLAT)


def consistency(runs, names):
    """Plots the states' mean NEES on a logarithmic axis, with the bounds of a consistent filter."""
    rows = _consistency_rows(runs, names)

    def draw(ax):
        for y, (_, item, shade) in enumerate(rows):
            if item.get("lower") and item.get("upper"):
                ax.barh(
                    y,
                    item["upper"] - item["lower"],
                    left=item["lower"],
                    height=0.7,
                    color=TRUTH,
                    alpha=0.5,
                )
            ax.plot([item["dof"]] * 2, [y - 0.35, y + 0.35], color=INK, linewidth=1.2)
            if item["mean_nees"]:
                ax.plot(item["mean_nees"], y, "o", color=shade, markersize=8)
        ax.set_xscale("log")
        _widen(ax, 0.5, 20.0)
        ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        _name_rows(ax, rows, "mean NEES")

    return drawing(0.6 + ROW * len(rows), draw, left=NAMES_WIDTH, top=FLAT)


def pose_over_time(runs, names):
    """Plots the distance of the estimated pose from the true one."""

    def draw(ax):
        _plot_series(ax, runs, names, "pose_error_m")
        _finish(ax, "Distance from the true pose", "m", runs)
        ax.set_xlabel("time (s)")
        _legend_of_runs(ax, runs)

    return drawing(2.6, draw)


def stage_times(runs, names):
    """Plots median (dot), 99th percentile (bar) and worst time of each stage for a message."""
    rows = [
        (_row_name(stage, name, runs), times, series_color(i))
        for i, (run, name) in enumerate(zip(runs, names))
        for stage, times in sorted((run.get("timing") or {}).items())
    ]

    def draw(ax):
        for y, (_, times, shade) in enumerate(rows):
            ax.plot([times["median_ms"], times["worst_ms"]], [y, y], color=shade)
            ax.plot(times["median_ms"], y, "o", color=shade, markersize=7)
            ax.plot(times["p99_ms"], y, "|", color=shade, markersize=13, markeredgewidth=2.5)
        _widen(ax, 0.0, 1.0)
        _name_rows(ax, rows, "time (ms)")

    return drawing(0.6 + ROW * len(rows), draw, left=NAMES_WIDTH, top=FLAT)


def _consistency_rows(runs, names):
    """Returns a list of (name, score_run's values, color), of each state of each run."""
    rows = []
    for state in ("position", "velocity", "pose of the vehicle"):
        for i, (run, name) in enumerate(zip(runs, names)):
            item = run["consistency"].get(state, run["pose"])
            if item is not None:
                rows.append((_row_name(state, name, runs), item, series_color(i)))
    return rows


def _row_name(what, name, runs):
    return plain(f"{what}, {name}" if len(runs) > 1 else what)


def _name_rows(ax, rows, label):
    """Names the rows, the first one at the top."""
    ax.set(yticks=range(len(rows)), ylim=(len(rows) - 0.5, -0.5), xlabel=label)
    ax.set_yticklabels([name for name, _, _ in rows])
    ax.grid(False, axis="y")


def _plot_series(ax, runs, names, key):
    for i, (run, name) in enumerate(zip(runs, names)):
        series = run["series"]
        ax.plot(
            _numbers(series["time_s"]),
            _numbers(series[key]),
            color=series_color(i),
            linewidth=1.0,
            alpha=0.9,
            label=plain(name),
        )


def _legend_of_runs(ax, runs):
    """Draws the legend above the plot; one run needs none."""
    if len(runs) > 1:
        position = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "borderaxespad": 0.0}
        ax.legend(ncol=len(runs), **position)


def _finish(ax, title, unit, runs):
    """Sets title and unit; the axis is as long as the runs, and starts at zero if possible."""
    ax.set_title(title, loc="left")
    ax.set_ylabel(unit)
    ends = [run["series"]["time_s"][-1] for run in runs if run["series"]["time_s"]]
    ax.set_xlim(0.0, max(ends, default=0.0) or 1.0)
    if ax.dataLim.ymin >= 0.0:
        ax.set_ylim(bottom=0.0)


def _widen(ax, low, high):
    """Makes the x axis span at least low to high."""
    left, right = ax.get_xlim()
    ax.set_xlim(min(left, low), max(right, high))


def _numbers(values):
    """Returns an array of floats, NaN for None."""
    return np.array(values, dtype=float)
