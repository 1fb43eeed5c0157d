# SPDX-License-Identifier: BSD-3-Clause
"""evaluate classes."""

from datmo_tools.evaluate import class_mistakes, tracks
from datmo_tools.evaluate.class_mistakes import as_dictionaries, mistakes_section, worst
from datmo_tools.evaluate.class_tally import calibration, class_sections, confusion
from datmo_tools.evaluate.metrics import short_names
from datmo_tools.evaluate.object_tally import BANDS
from datmo_tools.evaluate.report import Section
from datmo_tools.evaluate.track_classes import by_object, object_rows, read_track_classes
from datmo_tools.text_table import percent

DESCRIPTION = """\
Scores the classes of the tracks that score_run matched to true objects: by true class and by
object in how many of the frames they are right, and in how many a track has no known class yet;
which class is reported for which by range, also for tracks of no true object ("nothing"), and how
often a class is right at which probability. The worst mistakes are listed, and with --images shown
in the camera's images, with the track's box. Arguments are those of evaluate tracks: stationary
tracks count only with --set moving_tracks_only=false."""

HEADINGS = ("true class", "right, %", "of frames", "class unknown")


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    tracks.add_arguments(parser)
    class_mistakes.add_arguments(parser)


def evaluate(values):
    """Returns the runs' classes, and their sections. Raises InputError."""
    runs = tracks.score_runs(values)
    names = short_names([run["run"] for run in runs])
    results, sections = [], []
    for bag, run, name in zip(tracks.bags_of(values), runs, names):
        result, shown = _evaluate_run(bag, run, name, values)
        results.append(result)
        sections += shown
    return {"runs": results}, sections


def _evaluate_run(bag, run, name, values):
    """Returns the classes of one run as a dictionary, and its sections."""
    found = read_track_classes(bag, values.truth, tracks.settings_of(values), run["options"],
                               values.score_run)  # fmt: skip
    reach = run["options"]["region/range"]
    edges = [*(edge for edge in BANDS if edge < reach), reach]
    mistakes = worst(found.known, values.mistakes)
    result = {
        "run": run["run"],
        "classes": run["classes"],
        "objects": by_object(found.reports),
        "bands_m": [[near, far] for near, far in zip(edges, edges[1:])],
        "confusion": confusion(found.known, edges),
        "calibration": calibration(found.known),
        "mistakes": as_dictionaries(mistakes),
    }
    sections = [
        Section(f"Classes of {name}", rows=_rows(run["classes"])),
        Section(rows=object_rows(result["objects"])),
        *class_sections(result),
        *mistakes_section(mistakes, found.path, values, f"Worst mistakes of {name}"),
    ]
    return result, sections


def _rows(scored):
    classes = {**scored["by_class"], "all": scored}
    rows = [(kind, percent(item["right_share"]), str(item["frames"]), str(item["silent"]))
            for kind, item in classes.items()]  # fmt: skip
    return (HEADINGS, *rows)
