# SPDX-License-Identifier: BSD-3-Clause
"""Plots the levels of fusion on several drives."""

from matplotlib.ticker import MaxNLocator

from datmo_tools.evaluate.plot_style import series_color, picture, plain

ROW = 0.24  # inch, of a level
AROUND = 0.75  # inch, of titles and axes above and below the rows
COLUMNS = 3
NAMES_WIDTH = 1.3  # inch
LEGEND = 0.65  # inch, the upper margin
SPREAD = 0.4  # of a row: the height over which the drives' dots are spread


def _share(count, total):
    """Returns a percentage from a run's figures."""
    return lambda run: 100.0 * run[count] / run[total] if run[total] else None


def _percent(key):
    return lambda run: None if run[key] is None else 100.0 * run[key]


# Title of a plot, and its value as a function of a run's figures.
PLOTS = (
    ("moving objects missed (%)", _share("missed_objects", "moving_objects")),
    ("false tracks", lambda run: run["false_tracks"]),
    ("false tracks in the camera's view", lambda run: run["false_tracks_in_view"]),
    ("MOTA (%)", _percent("mota")),
    ("RMSE of the position (m)", lambda run: run["position_rmse_m"]),
    ("time for one scan (ms)", lambda run: run["time_per_scan_ms"]),
)


def comparison_plot(rows, kind):
    """Returns the bytes of the picture: a plot per figure with a row per level and a dot per run.

    rows: (name of the drive, level, figures() or None if the run failed); kind: of
    plot_style.KINDS.
    """
    levels = list(dict.fromkeys(level for _, level, _ in rows))
    drives = list(dict.fromkeys(drive for drive, _, _ in rows))
    lines = -(-len(PLOTS) // COLUMNS)

    def draw(axes):
        for ax, (title, value) in zip(axes.flat, PLOTS):
            for i, drive in enumerate(drives):
                dots = _dots(rows, drive, levels, value)
                shift = SPREAD * ((i + 0.5) / len(drives) - 0.5)
                ax.plot([x for x, _ in dots], [y + shift for _, y in dots], "o", markersize=4.5,
                        color=series_color(i), label=plain(drive), clip_on=False)  # fmt: skip
            _finish(ax, title, levels)
        axes.flat[0].legend(loc="lower left", bbox_to_anchor=(0.0, 1.12), borderaxespad=0.0,
                            ncol=len(drives))  # fmt: skip

    height = lines * (ROW * len(levels) + AROUND) + LEGEND
    return picture(kind, height, draw, left=NAMES_WIDTH, top=LEGEND, nrows=lines, ncols=COLUMNS,
                   sharey=True, squeeze=False)  # fmt: skip


def _dots(rows, drive, levels, value):
    """Returns (value, row) of each of the drive's runs that has one."""
    dots = []
    for name, level, run in rows:
        x = None if name != drive or run is None else value(run)
        if x is not None:
            dots.append((x, levels.index(level)))
    return dots


def _finish(ax, title, levels):
    """Puts the first level at the top; the axis starts at zero, unless something is below it."""
    ax.set_title(title, loc="left")
    ax.set(yticks=range(len(levels)), ylim=(len(levels) - 0.5, -0.5))
    ax.set_yticklabels(levels)
    if ax.dataLim.xmin >= 0.0:
        ax.set_xlim(left=0.0)
    ax.xaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 5, 10]))
