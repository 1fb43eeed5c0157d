"""A scene through simulator, stack and score: what the benchmarks on simulated drives share."""

import json
import subprocess
from pathlib import Path
from typing import NamedTuple

from datmo_tools.errors import InputError

STEPS = ("simulate", "run_bag", "score_run")


class StepFailed(Exception):
    """A program that gave up: which one, and the last that it said."""

    def __init__(self, step, said):
        lines = said.strip().splitlines()
        super().__init__(lines[-1] if lines else f"{step}: failed and said nothing")


class SimulatedDrive(NamedTuple):
    """One scene with the options that differ from those in its file."""

    scene: Path
    options: tuple = ()  # words "key=value", as simulate's --set takes them


def check_programs(folder):
    """Throws InputError unless the programs of all steps are in the folder (Path)."""
    for step in STEPS:
        if not (folder / step).is_file():
            raise InputError(f"{folder / step}: no such program, expected the built {step}")


def run(drive, programs, config, folder, score_options=()):
    """Report of score_run (dict) on the drive.

    programs: folder (Path) of the built programs; config: yaml file of the sensor set; folder:
    where drive.bag, result.bag and score.json are left; score_options: words "key=value" for
    score_run. Raises StepFailed.
    """
    recorded, computed = folder / "drive.bag", folder / "result.bag"
    score = folder / "score.json"
    _call(programs / "simulate", drive.scene, recorded, "--quiet", *_settings(drive.options))
    _call(programs / "run_bag", recorded, computed, "--config", config, "--with-truth", "--quiet")
    _call(programs / "score_run", computed, *_settings(score_options), "--out", score)
    return json.loads(score.read_text(encoding="utf-8"))


def _settings(assignments):
    return [word for assignment in assignments for word in ("--set", assignment)]


def _call(program, *words):
    done = subprocess.run(
        [str(program), *map(str, words)],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        errors="replace",
        check=False,
    )
    if done.returncode != 0:
        raise StepFailed(program.name, done.stderr)
