# SPDX-License-Identifier: BSD-3-Clause
"""evaluate operating_curve."""

import sys
import tempfile
from pathlib import Path

import yaml

from datmo_tools import command_line, programs
from datmo_tools.errors import InputError
from datmo_tools.evaluate.arguments import add_settings
from datmo_tools.evaluate.metrics import short_names
from datmo_tools.evaluate.plot_files import drawing_module
from datmo_tools.evaluate.report import Section
from datmo_tools.evaluate.score_run import find_score_run, score
from datmo_tools.text_table import percent, rounded
from datmo_tools.whole_files import write_whole
from datmo_tools.yaml_files import load_yaml

DESCRIPTION = """\
Plots missed frames against false tracks per minute for increasing values of the probability of
motion that the tracker requires.

Each drive, with its truth, is run and scored at each probability, and at the shipped one, which the
curve marks: that of the configuration, or the default. The plot is also written as a bitmap next to
the report."""

KEYS = ("tracker", "target", "motion_likelihood", "required_probability")
OF_SCORE_RUN = "attainable/required_probability"  # has the tracker's default
PROBABILITIES = [0.5, 0.65, 0.8, 0.9, 0.95, 0.99]
SECONDS = 60.0  # of a minute


def evaluate(values):
    """Returns the points, of each drive and of all, and their sections. Raises InputError."""
    _check(values.probabilities)
    plot = drawing_module("curve_plot")
    values.score_run = values.score_run or find_score_run()
    values.run_bag = values.run_bag or programs.find("run_bag", sys.argv[0])
    presets = [_read(path) for path in (values.config, values.preset) if path is not None]
    shipped = shipped_probability(presets)
    with tempfile.TemporaryDirectory(prefix="operating_curve_") as folder:
        points = [_point(values, float(p), Path(folder)) for p in sorted(set(values.probabilities))]
        shipped = points[0]["default"] if shipped is None else shipped
        if shipped not in [point["probability"] for point in points]:
            points.append(_point(values, shipped, Path(folder)))
    points.sort(key=lambda point: point["probability"])
    result = {"format": 1, "shipped": shipped, "points": points}
    write_whole(values.out, {"operating_curve.png": plot.curve_picture(result)})
    return result, [_section(result)._replace(picture=plot.curve_drawing(result))]


def shipped_probability(settings):
    """Returns what the last of the `settings` (dictionaries of yaml files) that has it requires;
    None: none has. Raises InputError."""
    found = None
    for setting in settings:
        for key in KEYS:
            setting = setting.get(key) if isinstance(setting, dict) else None
        if not isinstance(setting, (int, float, type(None))):
            raise InputError(f"{'/'.join(KEYS)} is {setting}, expected a number")
        found = found if setting is None else float(setting)
    return found


def with_probability(preset, probability):
    """Returns a copy of a preset (dictionary of a yaml file) that requires this probability. Raises
    InputError."""
    result = dict(preset)
    inner = result
    for key in KEYS[:-1]:
        section = inner.get(key) or {}
        if not isinstance(section, dict):
            raise InputError(f"{key} is {section}, expected a mapping of options")
        inner[key] = dict(section)
        inner = inner[key]
    inner[KEYS[-1]] = probability
    return result


def tally(drive, scored):
    """Returns the point of the curve from one score (dictionary of score_run)."""
    return {
        "drive": drive,
        "misses": scored["clear_mot"]["misses"],
        "required": scored["clear_mot"]["required"],
        "false_tracks": scored["thesis"]["false_tracks"],
        "duration_s": scored["duration_s"],
    }


def rates(drives):
    """Returns the share of missed frames and the false tracks per minute of all drives, or None."""
    required = sum(drive["required"] for drive in drives)
    minutes = sum(drive["duration_s"] for drive in drives) / SECONDS
    misses = sum(drive["misses"] for drive in drives)
    false = sum(drive["false_tracks"] for drive in drives)
    return {
        "missed_share": misses / required if required else None,
        "false_tracks_per_minute": false / minutes if minutes else None,
    }


def _check(probabilities):
    for value in probabilities:
        if not 0.5 <= value < 1.0:
            raise InputError(f"--probabilities: {value:g}, expected at least 0.5 and less than 1")


def _read(path):
    content = load_yaml(path)
    if not isinstance(content or {}, dict):
        raise InputError(f"{path}: holds no options, expected a mapping")
    return content or {}


def _point(values, probability, folder):
    preset = folder / "preset.yaml"
    base = {} if values.preset is None else _read(values.preset)
    preset.write_text(yaml.safe_dump(with_probability(base, probability)), encoding="utf-8")
    settings = programs.settings(values.set)
    drives = []
    for bag in values.bags:
        run = folder / "run.bag"
        words = [bag, run, "--config", values.config, "--preset", preset, "--with-truth", "--quiet"]
        try:
            programs.call(Path(values.run_bag), *words,
                          *(["--road-border"] if values.road_border else []))  # fmt: skip
        except programs.StepFailed as error:
            raise InputError(str(error)) from error
        scored = score(values.score_run, run, None, settings)
        drives.append({**tally(str(bag), scored), **rates([tally(str(bag), scored)])})
    default = scored["options"][OF_SCORE_RUN]
    return {"probability": probability, **rates(drives), "drives": drives, "default": default}


def _section(result):
    drives = short_names([drive["drive"] for drive in result["points"][0]["drives"]])
    rows = [["required probability", "missed, %", "false a minute",
             *(f"{name}: missed, %" for name in drives)]]  # fmt: skip
    for point in result["points"]:
        mark = " (shipped)" if point["probability"] == result["shipped"] else ""
        rows.append([f"{point['probability']:g}{mark}", percent(point["missed_share"]),
                     rounded(point["false_tracks_per_minute"], 2),
                     *(percent(drive["missed_share"]) for drive in point["drives"])])  # fmt: skip
    return Section("Operating curve", "missed frames against false tracks a minute", rows=rows)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("bags", nargs="+", type=Path, metavar="DRIVE.bag", help="drives with truth")
    add("--config", type=Path, required=True, metavar="FILE.yaml", help="sensor set of run_bag")
    add("--preset", type=Path, metavar="FILE.yaml", help="preset of run_bag")
    add("--road-border", action="store_true", help="of run_bag")
    add_settings(parser)
    add("--run-bag", metavar="PROGRAM", help="instead of the run_bag next to this")
    add("--probabilities", nargs="+", type=command_line.number, default=PROBABILITIES, metavar="P",
        help="required probabilities of motion, 0.5 to 1 (default %(default)s)")  # fmt: skip
