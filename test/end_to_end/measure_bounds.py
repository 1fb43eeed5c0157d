#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the bounds of the end-to-end tests: runs each simulated scene and each recording with many
seeds, prints median, worst and bound of its figures, and writes bounds.yaml, where the tests read them.
Recordings that are not in ../shared/data keep their bounds.

After a change that alters tracks on purpose, in the environment of the tests:

    source devel/setup.bash
    PYTHONPATH=tools:test/tools:$PYTHONPATH PATH=devel/lib/datmo_fusion:$PATH test/end_to_end/measure_bounds.py
"""

import argparse
import contextlib
import io
import os
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import yaml
from bounds import DIGITS, FILE, bound_of, misses_required
from datmo_tools import command_line
from drive_0005 import DATA
from recorded_figures import RECORDINGS
from scene_figures import SCENES

HEAD = """\
# SPDX-License-Identifier: BSD-3-Clause
# Written by measure_bounds.py; bounds.py says what a bound is.
"""


def main():
    values = _parser().parse_args()
    scenes = values.scenes or [name for name in SCENES if name not in RECORDINGS or DATA.is_dir()]
    seeds = list(range(1, values.seeds + 1))
    cases = [(scene, seed) for scene in scenes for seed in seeds]
    with ProcessPoolExecutor(values.jobs) as pool:
        measured = list(pool.map(figures_of, *zip(*cases)))
    found = yaml.safe_load(FILE.read_text(encoding="utf-8")) if FILE.is_file() else {"scenes": {}}
    for scene in scenes:
        runs = {seed: run for case, run in zip(cases, measured) for seed in [case[1]]
                if case[0] == scene}  # fmt: skip
        found["scenes"][scene] = summary(scene, runs)
        print(yaml.safe_dump({scene: found["scenes"][scene]}, sort_keys=False))
    FILE.write_text(HEAD + yaml.safe_dump(found, sort_keys=False), encoding="utf-8")


def figures_of(scene, seed):
    """What the scene's function says, in silence."""
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
        return SCENES[scene](Path(folder), seed)


def summary(scene, runs):
    """Of a dictionary seed -> figures: the bounds, and the seeds that miss what is required."""
    keys = ("median", "worst", "bound")
    bounded = {
        name: dict(zip(keys, map(_rounded, bound_of(name, [run[name] for run in runs.values()]))))
        for name in next(iter(runs.values()))
    }
    missed = {seed: misses_required(scene, run) for seed, run in runs.items()}
    failures = {seed: names for seed, names in missed.items() if names}
    return {"seeds": len(runs), "figures": bounded, **({"expected_failures": failures} if failures else {})}


def _rounded(value):
    return float(f"{value:.{DIGITS}g}")


def _scene(name):
    if name not in SCENES:
        raise argparse.ArgumentTypeError(f"'{name}', expected one of {', '.join(SCENES)}")
    return name


def _parser():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("scenes", nargs="*", type=_scene, metavar="SCENE",
                        help=f"of {', '.join(SCENES)} (default: all)")  # fmt: skip
    parser.add_argument("--seeds", type=command_line.count, default=10, metavar="N",
                        help="from 1 (default %(default)s)")  # fmt: skip
    parser.add_argument("--jobs", type=command_line.count, default=os.cpu_count(), metavar="N",
                        help="runs at a time (default: all cores)")  # fmt: skip
    return parser


if __name__ == "__main__":
    main()
