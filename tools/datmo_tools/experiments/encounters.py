# SPDX-License-Identifier: BSD-3-Clause
"""Risks over encounters after public test protocols: the command line and the runs."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import yaml
from tqdm import tqdm

from datmo_tools import command_line, programs
from datmo_tools.errors import InputError
from datmo_tools.experiments.encounter_scenes import AVOIDED, ENDINGS, STOPS, encounters, scene
from datmo_tools.experiments.random_encounters import random_scenes
from datmo_tools.yaml_files import parse_yaml

DESCRIPTION = """\
Makes scenes after the public test protocols (or, with --random, at random about them), and the
risks of each by each method, from the true objects or from the stack's own tracks:
FOLDER/scenes/*.yaml, FOLDER/<method>/*.bag. Then `evaluate risk METHOD=FOLDER/METHOD ...`."""

METHODS = ("futures", "thesis", "ttc_boxes", "rss")


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run("encounters", lambda: _run(values), "bags")


def write_scenes(folder, values):
    """Files (list of Path) of the scenes."""
    folder.mkdir(parents=True, exist_ok=True)
    if values.random:
        named = [(f"random_{number:04d}", each)
                 for number, each in enumerate(random_scenes(values.random, values.seed))]  # fmt: skip
    else:
        named = [(each.name, scene(each, values.seed)) for each in encounters(values.endings)]
    files = []
    for name, each in named:
        if values.only in name:
            files.append(folder / f"{name}.yaml")
            files[-1].write_text(yaml.safe_dump(each), encoding="utf-8")
    return files


def _run(values):
    scenes = write_scenes(values.folder / "scenes", values)
    if not scenes:
        raise InputError(f"--only {values.only}: no scene has that in its name")
    if values.scenes_only:
        return
    needed = ("simulate", "run_bag") if values.config else ("true_risks",)
    programs.check(values.programs, needed)
    steps = _of_tracks if values.config else _of_truth
    for method in values.methods:
        (values.folder / method).mkdir(exist_ok=True)
    with ThreadPoolExecutor(values.jobs) as pool:
        said = list(tqdm(pool.map(lambda each: _guarded(steps, each, values), scenes), "scenes",
                         len(scenes)))  # fmt: skip
    for line in filter(None, said):
        print(line)


def _guarded(steps, each, values):
    """What went wrong with a scene; None: nothing. Random ones may be impossible: they collide."""
    try:
        steps(each, values)
    except programs.StepFailed as failure:
        if not values.random:
            raise
        return f"{each.stem}: {failure}"
    return None


def _of_truth(each, values):
    for method in values.methods:
        programs.call(values.programs / "true_risks", each, values.folder / method / f"{each.stem}.bag",
                      "--risk", f"method={method}", *_words("--risk", values.set))  # fmt: skip


def _of_tracks(each, values):
    recorded = values.folder / f"{each.stem}_recorded.bag"
    programs.call(values.programs / "simulate", each, recorded, "--quiet")
    for method in values.methods:
        preset = values.folder / f"{method}.yaml"
        risk = {"method": method}
        for assignment in values.set:
            key, _, value = assignment.partition("=")
            risk[key] = parse_yaml(assignment, value)
        preset.write_text(yaml.safe_dump({"risk": risk}), encoding="utf-8")
        programs.call(values.programs / "run_bag", recorded, values.folder / method / f"{each.stem}.bag",
                      "--config", values.config, "--preset", preset, "--road-border", "--risk",
                      "--with-truth", "--quiet")  # fmt: skip
    recorded.unlink()


def _words(option, assignments):
    return [word for assignment in assignments for word in (option, assignment)]


def _parser():
    parser = command_line.new_parser("encounters", DESCRIPTION)
    add = parser.add_argument
    add("folder", type=Path, metavar="FOLDER", help="for scenes and bags")
    add("--programs", required=True, type=Path, metavar="DIR", help="of simulate and run_bag")
    add("--config", type=Path, metavar="CONFIG.yaml",
        help="a sensor set: own tracks by run_bag; without it risks of the true objects")  # fmt: skip
    add("--methods", nargs="+", choices=METHODS, default=METHODS, help="(default all)")
    add("--random", type=command_line.count, default=0, metavar="N",
        help="so many encounters at random in place of those of the protocols")  # fmt: skip
    add("--seed", type=int, default=1, metavar="N", help="of all random numbers (default 1)")
    add("--endings", nargs="+", choices=[*ENDINGS, STOPS, AVOIDED], default=ENDINGS, metavar="E",
        help="hit, space, time (near misses; default all three), stop (before the lane), avoided "
        "(the host brakes)")  # fmt: skip
    add("--scenes-only", action="store_true", help="writes the scenes, and no risks")
    add("--only", default="", metavar="TEXT", help="only scenes with this in their names")
    add("--set", action="append", default=[], metavar="KEY=VALUE", help="of risk, repeatable")
    add("--jobs", type=command_line.count, default=1, metavar="N", help="scenes at a time")
    return parser
