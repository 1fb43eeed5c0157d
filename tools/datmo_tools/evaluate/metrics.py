# SPDX-License-Identifier: BSD-3-Clause
"""A figure of score_run as shown to a reader: name, unit, and which run is the best.

A run is the dictionary that score_run wrote. A figure without a sample is None there, and "-" here.
"""

import math
from typing import Callable, NamedTuple, Optional

NO_VALUE = "-"


def higher(value):
    """Cost of a figure that should be high."""
    return -value


def lower(value):
    """Cost of a figure that should be low."""
    return value


def near(target):
    """Cost of a figure that should be `target`: how many times it is too high or too low."""

    def cost(value):
        return abs(math.log(value / target)) if value > 0.0 else math.inf

    return cost


class Metric(NamedTuple):
    """One figure as a reader sees it."""

    name: str
    path: str  # keys in the run, with dots between them
    unit: str = ""
    scale: float = 1.0  # shown = stored * scale
    digits: int = 0  # after the decimal point
    cost: Optional[Callable] = None  # the lower, the better; None: neither is better

    def value(self, item):
        """Returns the figure of `item` (a run or one of its objects) in the shown unit, or None."""
        for key in self.path.split("."):
            if isinstance(item, list):
                item = dict(enumerate(item))
            item = (item or {}).get(int(key) if key.isdigit() else key)
        return None if item is None else item * self.scale

    def text(self, value):
        """Formats a value without its unit."""
        if value is None or not math.isfinite(value):
            return NO_VALUE
        return f"{value:.{self.digits}f}"


def best_runs(metric, runs):
    """Returns the indices of the runs that are best in `metric`; empty without a choice.

    Runs with equal values in the table are equally good.
    """
    shown = {i: metric.text(metric.value(run)) for i, run in enumerate(runs)}
    shown = {i: text for i, text in shown.items() if text != NO_VALUE}
    if metric.cost is None or len(set(shown.values())) < 2:
        return set()
    minimum = min(metric.cost(float(text)) for text in shown.values())
    return {i for i, text in shown.items() if metric.cost(float(text)) == minimum}


def extent(run):
    """Describes the length of a run, and what could not be scored of it."""
    left_out = run["messages_left_out"]
    rest = f", {left_out} messages without known truth or pose left out" if left_out else ""
    return f"{run['duration_s']:.1f} s, {run['frames']} frames, {run['tracks']} tracks{rest}"


def short_names(paths):
    """Returns a name for each run: the file's stem, with as many folders as make it unique."""
    parts = [path.replace("\\", "/").split("/") for path in paths]
    parts = [[*folders, _without_ending(name)] for *folders, name in parts]
    count = 1
    longest = max(map(len, parts))
    while count < longest and len({tuple(part[-count:]) for part in parts}) < len(parts):
        count += 1
    return ["/".join(part[-count:]) for part in parts]


def _without_ending(name):
    return name[:-4] if name.endswith(".bag") else name
