# SPDX-License-Identifier: BSD-3-Clause
"""Runs a scene through simulator, stack and score: shared by the benchmarks on simulated drives."""

import json
from pathlib import Path
from typing import NamedTuple

from datmo_tools import programs as built
from datmo_tools.programs import call, settings

STEPS = ("simulate", "run_bag", "score_run")


class SimulatedDrive(NamedTuple):
    """One scene, with options that differ from those in its file."""

    scene: Path
    options: tuple = ()  # words "key=value", as simulate's --set takes them


def check_programs(folder):
    """Raises InputError unless the programs of all steps are in the folder (Path)."""
    built.check(folder, STEPS)


def run(drive, programs, config, folder, score_options=(), run_options=()):
    """Returns the report of score_run (dict) on the drive.

    programs: folder (Path) of the built programs; config: yaml file of the sensor set; folder:
    for drive.bag, result.bag and score.json; score_options: words "key=value" for
    score_run; run_options: words for run_bag. Raises StepFailed.
    """
    recorded = folder / "drive.bag"
    record(drive, programs, recorded)
    return run_recorded(recorded, programs, config, folder, score_options, run_options)


def record(drive, programs, recorded):
    """Simulates the drive into a bag (Path). Raises StepFailed."""
    call(programs / "simulate", drive.scene, recorded, "--quiet", *settings(drive.options))


def run_recorded(recorded, programs, config, folder, score_options=(), run_options=(), attainable=None):
    """Like run(), on an existing bag (Path): stack and score.

    attainable: bag (Path) with the scans, for the minimum delays that they allow.
    """
    computed = folder / "result.bag"
    call(programs / "run_bag", recorded, computed, "--config", config, "--with-truth", "--quiet",
         *run_options)  # fmt: skip
    return score(computed, programs, score_options, folder / "score.json", attainable)


def score(computed, programs, score_options, report, attainable=None):
    """Returns the report of score_run (dict) on a bag of run_bag (Path), kept in the file `report`
    (Path)."""
    scans = () if attainable is None else ("--attainable", attainable)
    call(programs / "score_run", computed, *settings(score_options), *scans, "--out", report)
    return json.loads(report.read_text(encoding="utf-8"))
