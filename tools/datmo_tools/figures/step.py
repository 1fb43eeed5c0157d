# SPDX-License-Identifier: BSD-3-Clause
"""A step of scripts/figures: jobs that run in parallel, and the figures from their results."""

import json
import sys
from pathlib import Path
from typing import Callable, NamedTuple

import yaml

from datmo_tools import programs


class Bench(NamedTuple):
    """What the steps work with."""

    source: Path  # root of the sources
    build: Path  # build folder
    programs: Path  # folder of the built programs
    data: Path  # of recordings that are not in the repository
    seeds: tuple  # of the simulated data sets

    def config(self, name):
        """Returns the yaml file (Path) of a sensor set."""
        return self.source / "config" / f"{name}.yaml"

    def scene(self, name):
        """Returns the yaml file (Path) of a simulated scene."""
        return self.source / "rosbag_fixtures" / "scenes" / f"{name}.yaml"

    def call(self, program, *words):
        """Runs a built program to its end. Raises programs.StepFailed."""
        programs.call(self.programs / program, *words)

    def output_of(self, program, *words):
        """Like call(), but returns the program's output as text."""
        return programs.output_of(self.programs / program, *words)

    def experiment(self, name, *words):
        """The same for a tool of datmo_tools.experiments."""
        programs.call(Path(sys.executable), "-m", "datmo_tools", f"experiments.{name}", *words)

    def evaluated(self, folder, subcommand, *words):
        """Runs evaluate; returns what it writes (dict) to the folder (Path)."""
        self.call("evaluate", subcommand, *words, "--out", folder)
        return read_json(folder / f"{subcommand}.json")


class Job(NamedTuple):
    """A part of a step that needs one core."""

    name: str  # of its folder
    work: Callable  # of that folder (Path), which is deleted later; returns what JSON can hold


class Step(NamedTuple):
    """Figures that belong together."""

    name: str
    shows: str  # in a few words
    command: str  # to measure such a figure by hand
    jobs: Callable  # of a Bench: list of Job
    figures: Callable  # of the list of their results: a dictionary that JSON can hold
    needs: tuple = ()  # paths below Bench.data
    seeded: bool = False  # whether it depends on Bench.seeds
    on_request: bool = False
    timed: bool = False  # measures time: nothing may run in parallel, and another machine's do not count


def only(results):
    """Returns the figures of a step with one job."""
    return results[0]


def by_name(results):
    """Returns the figures of a step whose jobs return (name, figures)."""
    return dict(sorted(map(tuple, results)))  # lists after JSON


def preset(folder, settings):
    """Returns the words for run_bag that lay settings (dict) over the sensor set, by a file in the
    folder (Path)."""
    file = folder / "preset.yaml"
    file.write_text(yaml.safe_dump(settings), encoding="utf-8")
    return ("--preset", file)


def read_json(file):
    """Returns the content of a JSON file (Path)."""
    return json.loads(file.read_text(encoding="utf-8"))
