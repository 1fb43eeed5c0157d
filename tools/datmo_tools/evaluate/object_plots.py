# SPDX-License-Identifier: BSD-3-Clause
"""Plots one run's objects for evaluate: which were tracked when and by which id, and where.

Each function returns an SVG element.
"""

import numpy as np

from datmo_tools.evaluate.plot_style import FALSE, INK, MISSED, TRUTH, WIDTH, series_color, drawing, plain

ROW = 0.2  # inch
BAR = 0.76  # of a row
PALE = 0.3  # opacity of what does not count
MIN_HEIGHT, MAX_HEIGHT = 3.0, 9.0  # inch, of the map
ID_SHARE = 0.025  # of the shown time: a shorter bar has no room for its id
JITTER = 0.5  # of a period: a later frame is not the next one


def timeline(run):
    """Draws a row for each object; its bar changes color when another track takes over.

    Pale is a track on an object that did not have to be found at that time. Objects that neither
    had to be found nor have a track are left out.
    """
    paths = sorted(filter(_concerns, run["series"]["true_paths"]), key=_first_concern)
    period = _period(run)

    def draw(ax):
        for y, path in enumerate(paths):
            _draw_row(ax, y, path, period, ID_SHARE * run["duration_s"])
        ax.set(yticks=range(len(paths)), ylim=(len(paths) - 0.4, -0.6), xlabel="time (s)")
        ax.set_yticklabels([plain(f"{path['label']} {path['id']}") for path in paths], fontsize=8)
        ax.set_xlim(0.0, run["duration_s"] or 1.0)
        ax.grid(False, axis="y")

    return drawing(0.6 + ROW * max(len(paths), 1), draw, left=1.3, top=0.05)


def _concerns(path):
    """Whether the object ever has to be found or has a track."""
    return any(path["required"]) or any(number is not None for number in path["track_id"])


def _first_concern(path):
    """Returns when it first has to be found or has a track, s."""
    samples = zip(path["time_s"], path["required"], path["track_id"])
    return next(time for time, required, number in samples if required or number is not None)


def _draw_row(ax, y, path, period, room):
    times, required = path["time_s"], path["required"]
    missed = [duty or None for duty in required]
    _draw_bars(ax, y, spans(times, missed, period), facecolors=MISSED)
    tracked = [
        None if number is None else (number, duty)
        for number, duty in zip(path["track_id"], required)
    ]
    bars = spans(times, tracked, period)
    shades = {number: series_color(i) for i, number in enumerate(dict.fromkeys(k[0] for *_, k in bars))}
    for number, duty in dict.fromkeys(key for *_, key in bars):
        chosen = [bar for bar in bars if bar[2] == (number, duty)]
        _draw_bars(ax, y, chosen, facecolors=shades[number], alpha=1.0 if duty else PALE)
    for begin, end, (number, duty) in bars:
        if duty and end - begin > room:
            ax.text(begin + 0.1 * room, y, str(number), color="white", fontsize=6.5, va="center")


def _draw_bars(ax, y, bars, **style):
    """bars: see spans. One call for all, as each is slow."""
    where = [(begin, end - begin) for begin, end, _ in bars]
    if where:
        ax.broken_barh(where, (y - 0.5 * BAR, BAR), linewidth=0, **style)


def spans(times, keys, period):
    """Returns segments of one key: list of (begin, end, key); a sample lasts one `period`.

    times: increasing; keys: of the samples, None if there is nothing to show.
    """
    found = []
    for time, key in zip(times, keys):
        if key is None:
            continue
        if found and found[-1][2] == key and time - found[-1][1] <= JITTER * period:
            found[-1] = (found[-1][0], time + period, key)
        else:
            found.append((time, time + period, key))
    return found


def birds_eye(run):
    """Draws the paths of the vehicle, of the true objects and of the tracks, x to the right."""
    series = run["series"]
    on_truth = {number for path in series["true_paths"] for number in path["track_id"]}
    xy = [_xy(path) for path in [series["ego_true"], *series["true_paths"]]]
    height = _map_height(np.concatenate(xy, axis=1))

    def draw(ax):
        for path in filter(_concerns, series["true_paths"]):
            _line(ax, path, "true object", color=TRUTH, linewidth=4.0, alpha=PALE)
            _line(ax, _required_part(path), "has to be found", color=TRUTH, linewidth=4.0)
            _write_number(ax, path)
        for path in series["track_paths"]:
            if path["id"] in on_truth:
                _line(ax, path, "track", color=series_color(0), linewidth=1.1)
            else:
                _line(ax, path, "track on no true object", color=FALSE, linewidth=1.4)
        _line(ax, series["ego_true"], "vehicle, true", color=INK, linewidth=1.4)
        _line(ax, series["ego_estimated"], "vehicle, estimated", color=series_color(1), linestyle="--")
        ax.set_aspect("equal", adjustable="datalim")
        ax.set(xlabel="x (m)", ylabel="y (m)")
        _legend_of_kinds(ax)

    return drawing(height, draw)


def _map_height(xy):
    """Returns the height (inch) at which the map fills the figure's width, within limits."""
    finite = xy[:, np.isfinite(xy).all(axis=0)]
    if finite.size == 0:
        return MIN_HEIGHT
    width, depth = np.maximum(finite.max(axis=1) - finite.min(axis=1), 1.0)
    return float(np.clip(1.0 + WIDTH * depth / width, MIN_HEIGHT, MAX_HEIGHT))


def _line(ax, path, label, **style):
    ax.plot(*_xy(path), label=label, **style)


def _required_part(path):
    """Returns the path, interrupted where the object does not have to be found."""
    return {
        key: [value if duty else None for value, duty in zip(path[key], path["required"])]
        for key in ("x_m", "y_m")
    }


def _write_number(ax, path):
    """Writes the object's id where it is first seen."""
    if path["x_m"]:
        position = (path["x_m"][0], path["y_m"][0])
        ax.annotate(str(path["id"]), position, fontsize=7, color="#475569", clip_on=True)


def _legend_of_kinds(ax):
    """Draws one legend entry per kind of line, above the map."""
    handles = dict(zip(*reversed(ax.get_legend_handles_labels())))
    position = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "borderaxespad": 0.2}
    ax.legend(list(handles.values()), list(handles), ncol=len(handles), **position)


def _xy(path):
    """Returns an array of 2 x n, m."""
    return np.array([path["x_m"], path["y_m"]], dtype=float)


def _period(run):
    """Returns the median time between two frames, s."""
    steps = np.diff(run["series"]["time_s"])
    return float(np.median(steps)) if len(steps) else run["duration_s"]
