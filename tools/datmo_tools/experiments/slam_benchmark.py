# SPDX-License-Identifier: BSD-3-Clause
"""Runs CARMEN logs through the stack's SLAM, scored with their relations: command line and runs."""

import json
import tempfile
from pathlib import Path

from datmo_tools import command_line, programs
from datmo_tools.convert import carmen_bag
from datmo_tools.convert.carmen_clock import CLOCKS
from datmo_tools.errors import InputError
from datmo_tools.evaluate.relations import read_relations
from datmo_tools.evaluate.slam import score
from datmo_tools.text_table import aligned

DESCRIPTION = """\
Runs CARMEN logs through carmen_to_bag and run_bag with one configuration for all, and scores with
the relations the online pose of the grid SLAM, which is never corrected afterward, and the
trajectory with loops closed.
Prints a table with the figures that Kuemmerle et al. published for the log (2009) next to ours, and
the time per scan."""

FORMAT = 2  # of the JSON file
PROGRAMS = ("run_bag",)
TRAJECTORY = "/trajectory/optimized"

# Translational errors, m: mean and standard deviation, by the log's name. Source: table 1 of
# Kuemmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous Robots 27(4), 2009.
PUBLISHED = {
    "intel": {
        "scan matching": (0.220, 0.296),
        "particle filter (RBPF)": (0.070, 0.083),
        "graph mapping": (0.031, 0.026),
    }
}


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run("slam_benchmark", lambda: _run(values), product="score")


def find_pairs(folder):
    """Returns a sorted list of (log, relations) in `folder` (Path): logs with a NAME.relations.

    Raises InputError if there is none.
    """
    pairs = [
        (log, relations)
        for relations in sorted(folder.glob("*.relations"))
        for log in sorted(folder.glob(f"{relations.stem}.*"))
        if log != relations
    ]
    if not pairs:
        raise InputError(f"{folder}: no log with relations, expected NAME.clf and NAME.relations")
    return pairs


def benchmark(log, relations, built, config, options=carmen_bag.Options()):
    """Returns the result (dict that JSON can hold) of one log (Path) with its relations (Path).

    built: folder (Path) of run_bag; config: yaml file (Path). Raises InputError and
    programs.StepFailed.
    """
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        recorded, computed, times = (folder / file for file in ("in.bag", "out.bag", "times.json"))
        carmen_bag.convert(log, recorded, options)
        stage = ("--loop-closing", "--until", "loop_closing", "--times", times, "--quiet")
        programs.call(built / "run_bag", recorded, computed, "--config", config, *stage)
        taken = json.loads(times.read_text(encoding="utf-8"))
        return {
            "log": log.name.split(".")[0],
            "pose": _without_files(score(computed, relations, recording=recorded)),
            "loops_closed": _without_files(score(computed, relations, TRAJECTORY, recorded)),
            "odometry": _without_files(score(recorded, relations, "/odometry")),
            "time": taken["grid_slam"],
            "time_of_loops": taken["loop_closing"],
        }


def table(results):
    """Formats the results."""
    rows = [["", "translation, m", "rotation, deg", "relations", "scans",
             "ms a scan: mean", "median", "99 %"]]  # fmt: skip
    for result in results:
        log = result["log"]
        rows.append([*_row(f"{log}, odometry alone", result["odometry"]), *[""] * 4])
        for name, scored, time in (("grid_slam", "pose", "time"),
                                   ("loop_closing", "loops_closed", "time_of_loops")):  # fmt: skip
            rows.append([*_row(f"{log}, {name}", result[scored]), *_cost(result[time])])
        for method, figures in PUBLISHED.get(log, {}).items():
            rows.append([f"{log}, published: {method}", _spread(*figures, 3), *[""] * 6])
    notes = [
        "grid_slam: its pose as it is known online",
        "loop_closing: the trajectory as it is known at the end; its time, in a thread of its own live",
    ]
    if any(result["log"] in PUBLISHED for result in results):
        notes.append("published: by Kuemmerle et al., 2009")
    return "\n".join([aligned(rows), *notes])


def _cost(time):
    figures = [f"{1e3 * time[key]:.3f}" for key in ("mean_s", "median_s", "percentile_99_s")]
    return [str(time["runs"]), *figures]


def _row(name, scored):
    figures = [_spread(scored[key]["mean"], scored[key]["std"], digits)
               for key, digits in (("translation_m", 3), ("rotation_deg", 2))]  # fmt: skip
    return [name, *figures, f"{scored['used']}/{scored['used'] + scored['not_covered']}"]


def _spread(mean, deviation, digits):
    return f"{mean:.{digits}f} +- {deviation:.{digits}f}"


def _without_files(scored):
    """Returns the score without the names of temporary files."""
    return {key: value for key, value in scored.items() if key not in ("poses", "relations")}


def _run(values):
    pairs = _pairs(values.files)
    programs.check(values.programs, PROGRAMS)
    _check_files(pairs, values.config)
    options = carmen_bag.Options(clock=values.clock)
    try:
        results = [
            benchmark(log, relations, values.programs, values.config, options)
            for log, relations in pairs
        ]
    except programs.StepFailed as error:
        raise InputError(str(error)) from error
    print(table(results))
    command_line.write_json(values.out, {"format": FORMAT, "clock": values.clock, "results": results})


def _check_files(pairs, config):
    """Raises InputError early for what would otherwise fail in the last log's run."""
    for file in [config, *(log for log, _ in pairs)]:
        if not file.is_file():
            raise InputError(f"{file}: no such file")
    for _, relations in pairs:
        read_relations(relations)


def _pairs(files):
    if len(files) == 1:
        return find_pairs(files[0])
    if len(files) % 2 == 1:
        raise InputError(f"{len(files)} files, expected LOG RELATIONS pairs, or one folder")
    return list(zip(files[::2], files[1::2]))


def _parser():
    parser = command_line.new_parser("slam_benchmark", DESCRIPTION)
    add = parser.add_argument
    files = "pairs of log and relations file, or one folder with NAME.clf and NAME.relations"
    add("files", type=Path, nargs="+", metavar="FILE", help=files)
    add("--programs", type=Path, required=True, metavar="FOLDER", help="folder of run_bag")
    add("--config", type=Path, required=True, metavar="FILE.yaml", help="the sensor set")
    add("--clock", choices=CLOCKS, default="order", help="see carmen_to_bag (default %(default)s)")
    add("--out", type=command_line.output_file, metavar="FILE.json", help="for all figures")
    return parser
