# SPDX-License-Identifier: BSD-3-Clause
"""evaluate classes."""

from datmo_tools.evaluate.metrics import short_names
from datmo_tools.evaluate.report import Section
from datmo_tools.evaluate.tracks import add_arguments, score_runs
from datmo_tools.text_table import percent

__all__ = ["DESCRIPTION", "add_arguments", "evaluate"]

DESCRIPTION = """\
Scores the classes of the tracks that score_run matched to true objects, by true class: in how many
of the frames they are right, and in how many a track has no known class yet. Arguments are those of
evaluate tracks."""

HEADINGS = ("true class", "right, %", "of frames", "of no known class")


def evaluate(values):
    """Returns the runs' classes by score_run, and their sections. Raises InputError."""
    runs = score_runs(values)
    names = short_names([run["run"] for run in runs])
    result = [{"run": run["run"], "classes": run["classes"]} for run in runs]
    return {"runs": result}, [_section(run, name) for run, name in zip(result, names)]


def _section(run, name):
    classes = {**run["classes"]["by_class"], "all": run["classes"]}
    rows = [(kind, percent(item["right_share"]), str(item["frames"]), str(item["silent"]))
            for kind, item in classes.items()]  # fmt: skip
    return Section(f"Classes of {name}", rows=(HEADINGS, *rows))
