"""The table of evaluate on the terminal: metrics by section, then object by object."""

from datmo_tools.evaluate.metrics import NO_VALUE, best_runs, extent, short_names
from datmo_tools.evaluate.sections import OBJECT_METRICS, sections_of

BEST = "*"
NAME_WIDTH = 39  # the longest name of a metric
UNIT_WIDTH = 9
VALUE_WIDTH = 10


def table(runs):
    """Text of one run, or of several side by side with the best value marked."""
    names = short_names([run["run"] for run in runs])
    blocks = [_heading(runs)]
    blocks.append(_metrics(runs, names))
    blocks.append(_objects(runs[0]) if len(runs) == 1 else _objects_compared(runs, names))
    blocks.append(_standing(runs, names))
    if len(runs) > 1:
        blocks.append(f"{BEST} best of the runs")
    return "\n\n".join(blocks)


def _heading(runs):
    lines = [f"run    {run['run']}: {extent(run)}" for run in runs]
    lines.append(f"truth  {runs[0]['truth']}: {runs[0]['truth_objects']} objects")
    return "\n".join(lines)


def _metrics(runs, names):
    width = max([VALUE_WIDTH, *(len(name) + 2 for name in names)])
    lines = []
    if len(runs) > 1:
        lines.append(" " * (NAME_WIDTH + 2 + UNIT_WIDTH) + _cells(names, width))
    for section in sections_of(runs):
        lines.append(f"{section.title} ({section.source})")
        for metric in section.metrics:
            best = best_runs(metric, runs)
            texts = [
                metric.text(metric.value(run)) + (BEST if i in best else " ")
                for i, run in enumerate(runs)
            ]
            name = f"  {metric.name:{NAME_WIDTH}}{metric.unit:>{UNIT_WIDTH}}"
            lines.append((name + _cells(texts, width)).rstrip())
    return "\n".join(lines)


def _cells(texts, width):
    return "".join(f"{text:>{width}}" for text in texts)


def _objects(run):
    head = [metric.name for metric in OBJECT_METRICS]
    units = [metric.unit for metric in OBJECT_METRICS]
    lines = [
        f"{'id':>5}  {'object':14}" + _cells(head, VALUE_WIDTH) + "  ids of its tracks",
        f"{'':5}  {'':14}" + _cells(units, VALUE_WIDTH),
    ]
    for item in run["objects"]:
        texts = [metric.text(metric.value(item)) for metric in OBJECT_METRICS]
        tracks = " ".join(map(str, item["track_ids"])) if item["found"] else "MISSED"
        cells = _cells(texts, VALUE_WIDTH)
        lines.append(f"{item['id']:5d}  {_name(item):14}{cells}  {tracks}".rstrip())
    return "\n".join(lines)


def _objects_compared(runs, names):
    """One line an object; of each run completeness, delay and the number of ids."""
    width = max([24, *(len(name) + 2 for name in names)])
    by_run = [{item["id"]: item for item in run["objects"]} for run in runs]
    lines = [
        f"{'id':>5}  {'object':14}" + _cells(names, width),
        " " * 21 + _cells(["complete  delay  ids"] * len(runs), width),
    ]
    for number in sorted(set().union(*by_run)):
        items = [items.get(number) for items in by_run]
        name = _name(next(item for item in items if item))
        outcomes = _cells([_outcome(item) for item in items], width)
        lines.append(f"{number:5d}  {name:14}{outcomes}")
    return "\n".join(lines)


def _standing(runs, names):
    """One line a run: a list of parked cars is for the page."""
    lines = []
    for run, name in zip(runs, names):
        standing = run["standing_objects"]
        tracked = sum(item["tracked_frames"] > 0 for item in standing)
        lines.append(
            f"{name}: of {len(standing)} objects that never move {tracked} had a track at times"
        )
    return "\n".join(lines)


def _outcome(item):
    """How one run did on one object."""
    if item is None:
        return NO_VALUE
    if not item["found"]:
        return "MISSED"
    share, delay = (
        metric.text(metric.value(item)) + " " + metric.unit
        for metric in OBJECT_METRICS
        if metric.name in ("complete", "delay")
    )
    return f"{share:>8}{delay:>8}{len(item['track_ids']):>5}"


def _name(item):
    """The source's own name of the class, or ours."""
    return (item["label"] or item["class"])[:14]
