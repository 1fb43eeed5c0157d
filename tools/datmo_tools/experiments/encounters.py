# SPDX-License-Identifier: BSD-3-Clause
"""Scores risks in encounters following public test protocols: the command line and the runs."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import yaml
from tqdm import tqdm

from datmo_tools import command_line, programs
from datmo_tools.errors import InputError
from datmo_tools.evaluate import risk
from datmo_tools.evaluate.report import as_text
from datmo_tools.experiments.encounter_scenes import AVOIDED, ENDINGS, STOPS, encounters, scene
from datmo_tools.experiments.random_encounters import random_scenes
from datmo_tools.programs import StepFailed

DESCRIPTION = """\
Makes scenes following the public test protocols (or, with --random, random variations of them),
assesses the risks of each by each method, from the true objects and from the stack's own tracks,
and scores the methods side by side like `evaluate risk`. For the own tracks there is one run for
all methods. Writes FOLDER/scenes/*.yaml, FOLDER/<true or own>/<method>/*.bag and
FOLDER/encounters.json."""

METHODS = ("futures", "thesis", "ttc_boxes", "rss")
TRUE, OWN = "true", "own"  # whose tracks
PROGRAMS = {TRUE: ("true_risks",), OWN: ("simulate", "run_bag", "replay_risks")}
RESULT = "encounters.json"
FORMAT = 1  # of that file


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run("encounters", lambda: _run(values), "score")


def write_scenes(folder, values):
    """Returns the files (list of Path) of the scenes."""
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for seed in values.seeds:
        suffix = "" if len(values.seeds) == 1 else f"_seed_{seed}"
        for name, each in _drawn(values, seed):
            if values.only in name:
                files.append(folder / f"{name}{suffix}.yaml")
                files[-1].write_text(yaml.safe_dump(each), encoding="utf-8")
    return files


def _drawn(values, seed):
    """Returns names and scenes (dicts)."""
    if values.random:
        return [(f"random_{number:04d}", each)
                for number, each in enumerate(random_scenes(values.random, seed))]  # fmt: skip
    return [(each.name, scene(each, seed)) for each in encounters(values.endings)]


def _run(values):
    scenes = write_scenes(values.folder / "scenes", values)
    if not scenes:
        raise InputError(f"--only {values.only}: no scene has that in its name")
    if values.scenes_only:
        return
    if OWN in values.tracks and values.config is None:
        raise InputError("--config is missing, expected a sensor set for --tracks own")
    programs.check(values.programs, [name for each in values.tracks for name in PROGRAMS[each]])
    result = {"format": FORMAT, "seeds": values.seeds, "scenes": len(scenes)}
    for tracks in values.tracks:
        result[tracks] = _scores(tracks, scenes, values)
        print(as_text(risk.sections(result[tracks], f", {tracks} tracks")), end="\n\n")
    command_line.write_json(values.folder / RESULT, result)


def _scores(tracks, scenes, values):
    """Returns the score of each method, of the bags of this run."""
    folder = values.folder / tracks
    for method in values.methods:
        (folder / method).mkdir(parents=True, exist_ok=True)
    steps = _of_tracks if tracks == OWN else _of_truth
    with ThreadPoolExecutor(values.jobs) as pool:
        failures = list(tqdm(pool.map(lambda each: _guarded(steps, each, folder, values), scenes),
                             f"{tracks} tracks", len(scenes)))  # fmt: skip
    for line in filter(None, failures):
        print(line)
    names = [each.stem for each, failure in zip(scenes, failures) if failure is None]
    return {method: risk.score_of([folder / method / f"{name}.bag" for name in names])
            for method in values.methods}  # fmt: skip


def _guarded(steps, each, folder, values):
    """Returns what went wrong with a scene, or None. Random ones may be impossible."""
    try:
        steps(each, folder, values)
    except StepFailed as failure:
        if not values.random:
            raise InputError(f"{each.stem}: {failure}") from failure
        return f"{each.stem}: {failure}"
    return None


def _of_truth(each, folder, values):
    for method in values.methods:
        programs.call(values.programs / "true_risks", each, folder / method / f"{each.stem}.bag",
                      *_options("--risk", method, values))  # fmt: skip


def _of_tracks(each, folder, values):
    recorded, run = folder / f"{each.stem}_recorded.bag", folder / f"{each.stem}_run.bag"
    config = ("--config", values.config)
    try:
        programs.call(values.programs / "simulate", each, recorded, "--quiet")
        programs.call(values.programs / "run_bag", recorded, run, *config, "--road-border", "--with-truth",
                      "--quiet")  # fmt: skip
        for method in values.methods:
            programs.call(values.programs / "replay_risks", run, recorded,
                          folder / method / f"{each.stem}.bag", *config,
                          *_options("--set", method, values))  # fmt: skip
    finally:
        recorded.unlink(missing_ok=True)
        run.unlink(missing_ok=True)


def _options(option, method, values):
    return programs.settings((f"method={method}", *values.set), option)


def _parser():
    parser = command_line.new_parser("encounters", DESCRIPTION)
    add = parser.add_argument
    add("folder", type=Path, metavar="FOLDER", help="folder for scenes, bags and scores")
    add("--programs", required=True, type=Path, metavar="DIR", help="of simulate, run_bag and others")
    add("--tracks", nargs="+", choices=(TRUE, OWN), default=(TRUE, OWN),
        help="tracks of the true objects, or of run_bag (default both)")  # fmt: skip
    add("--config", type=Path, metavar="CONFIG.yaml", help="the sensor set, for own tracks")
    add("--methods", nargs="+", choices=METHODS, default=METHODS, help="(default all)")
    add("--random", type=command_line.count, default=0, metavar="N",
        help="random encounters per seed, instead of those of the protocols")  # fmt: skip
    add("--seeds", type=int, nargs="+", default=[1], metavar="N",
        help="seeds of all random numbers, each with a set of scenes (default 1)")  # fmt: skip
    add("--endings", nargs="+", choices=[*ENDINGS, STOPS, AVOIDED], default=ENDINGS, metavar="E",
        help="hit, space, time (near misses; default all three), stop (before the lane), avoided "
        "(the host brakes)")  # fmt: skip
    add("--scenes-only", action="store_true", help="write only the scenes, no risks")
    add("--only", default="", metavar="TEXT", help="only scenes with this in their names")
    add("--set", action="append", default=[], metavar="KEY=VALUE", help="of risk, repeatable")
    add("--jobs", type=command_line.count, default=1, metavar="N", help="parallel scenes")
    return parser
