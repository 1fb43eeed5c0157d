"""The page of evaluate: tables and plots of one run or of several, whole in one HTML file."""

import json
from html import escape

from datmo_tools.evaluate import object_plots
from datmo_tools.evaluate import plots
from datmo_tools.evaluate.metrics import best_runs, extent, short_names
from datmo_tools.evaluate.sections import OBJECT_METRICS, SECTIONS, STANDING_METRICS, sections_of
from datmo_tools.evaluate.plot_style import PAGE_STYLE, series_color

TILES = {
    "hota.hota": "HOTA",
    "clear_mot.mota": "MOTA",
    "identity.idf1": "IDF1",
    "errors.position_rmse_m": "error of position",
    "errors.velocity_rmse_mps": "error of velocity",
    "pose.end_error_m": "pose at the end",
}


def page(runs):
    """HTML of the report on runs that score_run has scored."""
    names = short_names([run["run"] for run in runs])
    title = escape("Evaluation of " + ", ".join(names))
    of_each = [block for run, name in zip(runs, names) for block in _of_one_run(run, name, runs)]
    of_all = list(_of_all_runs(runs, names))
    blocks = [
        f"<h1>{title}</h1>",
        _summary(runs, names),
        _tiles(runs[0]) if len(runs) == 1 else "",
        _block("Figures", _hint_of_best(runs), _metrics(runs, names)),
        *(of_each + of_all if len(runs) == 1 else of_all + of_each),
        _block("Options", "As given to score_run, or its defaults.", _options(runs[0])),
    ]
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{title}</title><style>{PAGE_STYLE}</style></head>\n"
        "<body><main>" + "\n".join(blocks) + "</main></body></html>\n"
    )


def _of_all_runs(runs, names):
    """What shows all runs in one picture."""
    yield _block(
        "Errors over time",
        "Of the true objects that count and have a track; no line where none has.",
        plots.errors_over_time(runs, names),
    )
    yield _block(
        "HOTA by threshold",
        "How the score falls as matches have to be closer; a steep fall says that tracks are on "
        "the objects, but not accurate.",
        plots.hota_over_alpha(runs, names),
    )
    yield _block(
        "Is the covariance honest?",
        "Mean NEES (dot) against its expectation (line) and the 95 % bounds of the mean of an "
        "honest filter (bar, where given). To the right the covariance is too small, to the left "
        "too large.",
        plots.consistency(runs, names),
    )
    yield _block(
        "Pose of the vehicle",
        "The maps of the run and of the truth laid on each other at the first pose.",
        plots.pose_over_time(runs, names),
    )
    if any(run.get("timing") for run in runs):
        yield _block(
            "Time of each stage",
            "For one message: median (dot), 99th percentile (bar), worst (end of the line).",
            plots.stage_times(runs, names),
        )


def _hint_of_best(runs):
    if len(runs) < 2:
        return ""
    return "The best of the runs is marked; figures that look the same are equally good."


def _of_one_run(run, name, runs):
    """What needs a picture for each run."""
    of = f": {name}" if len(runs) > 1 else ""
    yield _block(
        "Who was tracked when" + of,
        "When a true object has to be found: with a track on it (blue; another color where "
        "another track takes over; the number is its id), or without (red). Pale: a track on it "
        "while it does not have to be found.",
        object_plots.timeline(run),
    )
    yield _block("Tracked, missed, false" + of, "", plots.counts_over_time(run))
    yield _block(
        "Seen from above" + of,
        "In the map of the truth. Wide and gray: true objects, with their id where they come up.",
        object_plots.birds_eye(run),
    )
    yield _block(
        "Objects" + of,
        "Delay: from the first frame in which the object has to be found to its first track.",
        _objects(run),
    )
    yield _block(
        "Tracks on objects that never move" + of,
        f"Of {len(run['standing_objects'])} parked cars and the like that the truth knows, these "
        "had a track at times, which is false.",
        _standing(run),
    )


def _block(title, hint, content):
    hint = f"<p>{escape(hint)}</p>" if hint else ""
    return f"<section><h2>{escape(title)}</h2>{hint}{content}</section>"


def _summary(runs, names):
    lines = [
        f"<li><span class='dot' style='background:{series_color(i)}'></span><b>{escape(name)}</b> "
        f"{escape(run['run'])}: {extent(run)}</li>"
        for i, (run, name) in enumerate(zip(runs, names))
    ]
    truth = f"{escape(runs[0]['truth'])}: {runs[0]['truth_objects']} objects"
    return f"<ul class='runs'>{''.join(lines)}<li><b>truth</b> {truth}</li></ul>"


def _tiles(run):
    """The figures that most readers look for first."""
    found = sum(item["found"] for item in run["objects"])
    tiles = [("objects found", f"{found} of {len(run['objects'])}", "")]
    metrics = {metric.path: metric for section in SECTIONS for metric in section.metrics}
    for path, name in TILES.items():
        metric = metrics[path]
        tiles.append((name, metric.text(metric.value(run)), metric.unit))
    return (
        "<div class='tiles'>"
        + "".join(
            f"<div><b>{escape(text)}<small> {unit}</small></b><span>{escape(name)}</span></div>"
            for name, text, unit in tiles
        )
        + "</div>"
    )


def _metrics(runs, names):
    """A table for each section; a column for each run."""
    tables = []
    for section in sections_of(runs):
        heads = [section.source, *(names if len(runs) > 1 else [""] * len(runs)), ""]
        rows = [_row("th", heads)]
        for metric in section.metrics:
            best = best_runs(metric, runs)
            texts = [metric.text(metric.value(run)) for run in runs]
            kinds = ["best" if i in best else "value" for i in range(len(runs))]
            rows.append(_row("td", [metric.name, *texts, metric.unit], ["", *kinds, "unit"]))
        tables.append(f"<div><h3>{escape(section.title)}</h3>{_table('metrics', rows)}</div>")
    return f"<div class='{'wide' if len(runs) > 2 else 'columns'}'>{''.join(tables)}</div>"


def _objects(run):
    heads = ["id", "object", "class", *(m.name for m in OBJECT_METRICS), "its tracks"]
    units = ["", "", "", *(m.unit for m in OBJECT_METRICS), "ids"]
    rows = [_row("th", heads), _row("th", units, ["unit"] * len(units))]
    for item in run["objects"]:
        texts = [item["id"], item["label"], item["class"]]
        texts += [metric.text(metric.value(item)) for metric in OBJECT_METRICS]
        texts.append(" ".join(map(str, item["track_ids"])) if item["found"] else "missed")
        kinds = None if item["found"] else ["missed"] * len(texts)
        rows.append(_row("td", texts, kinds))
    return _table("objects", rows)


def _standing(run):
    heads = ["id", "object", "class", *(m.name for m in STANDING_METRICS)]
    units = ["", "", "", *(m.unit for m in STANDING_METRICS)]
    rows = [_row("th", heads), _row("th", units, ["unit"] * len(units))]
    for item in run["standing_objects"]:
        if item["tracked_frames"] > 0:
            texts = [item["id"], item["label"], item["class"]]
            texts += [metric.text(metric.value(item)) for metric in STANDING_METRICS]
            rows.append(_row("td", texts))
    return _table("objects standing", rows)


def _options(run):
    rows = [_row("td", [key, json.dumps(value)]) for key, value in sorted(run["options"].items())]
    return _table("options", rows)


def _table(kind, rows):
    return f"<table class='{kind}'>{''.join(rows)}</table>"


def _row(tag, texts, kinds=None):
    """A row of the table; kinds: the style of each cell."""
    cells = (
        f"<{tag} class='{kind}'>{escape(str(text))}</{tag}>"
        for text, kind in zip(texts, kinds or [""] * len(texts))
    )
    return f"<tr>{''.join(cells)}</tr>"
