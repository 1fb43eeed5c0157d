# SPDX-License-Identifier: BSD-3-Clause
"""Calls score_run, which matches tracks to true objects and scores a run; reads its results."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from datmo_tools import programs
from datmo_tools.errors import InputError

FORMAT = 1  # of score_run's JSON that is supported here


class FrameMatches(NamedTuple):
    """score_run's matches of one list of tracks. Tracks that do not count are in none of these."""

    objects: dict  # id of a track -> that of its true object
    distances: dict  # id of a track -> m, to that object
    required: set  # ids of the true objects that have to be found
    false: set  # ids of the tracks of no object
    counted: set  # ids of all tracks that count
    switches: dict  # id of an object -> ids of its last track and of its current one


def find_score_run(beside=None):
    """Returns the path of the program score_run, see programs.find. beside: default sys.argv[0]."""
    return programs.find("score_run", beside or sys.argv[0])


def score(program, run, truth, settings):
    """Returns the dictionary that `program` writes on the bag `run`.

    truth: bag with the truth, or None if the run's bag has it; settings: words for the command
    line of score_run. If it fails, it has printed why: its exit code becomes ours (SystemExit).
    """

    def call(words):
        done = subprocess.run([program, *words], check=False)
        if done.returncode != 0:
            raise SystemExit(done.returncode if done.returncode > 0 else 1)

    return _written(call, [*_bags(run, truth), *settings, "--out"])


def matches(run, truth, options):
    """Returns a dictionary stamp (ns) -> FrameMatches of the bag `run`.

    truth: see score(); options: dictionary of score_run's. Raises InputError if it fails.
    """
    words = programs.settings(f"{key}={value}" for key, value in options.items())
    return matches_by(run, truth, words)


def matches_by(run, truth, settings, program=None):
    """Like matches(), with `settings` as in score(); program: score_run, by default the found one."""

    def call(words):
        try:
            programs.call(Path(program or find_score_run()), *words)
        except programs.StepFailed as error:
            raise InputError(str(error)) from error

    written = _written(call, [*_bags(run, truth), *settings, "--matches"])
    return {frame["stamp_ns"]: _frame_matches(frame) for frame in written["frames"]}


def _bags(run, truth):
    return [str(run)] if truth is None else [str(run), str(truth)]


def _written(call, words):
    """Returns what `call`, of score_run with the words and a file, writes to that file."""
    with tempfile.TemporaryDirectory(prefix="score_run_") as folder:
        file = Path(folder) / "written.json"
        call([*words, str(file)])
        written = json.loads(file.read_text(encoding="utf-8"))
    if written["format"] != FORMAT:
        raise InputError(f"score_run writes format {written['format']}, expected {FORMAT}")
    return written


def _frame_matches(frame):
    pairs = frame["matches"]
    objects = {pair["track_id"]: pair["truth_id"] for pair in pairs}
    return FrameMatches(
        objects,
        {pair["track_id"]: pair["distance_m"] for pair in pairs},
        {pair["truth_id"] for pair in pairs if pair["required"]} | set(frame["missed"]),
        set(frame["false"]),
        {*objects, *frame["false"], *frame["neutral"]},
        {item["truth_id"]: (item["from"], item["to"]) for item in frame["switches"]},
    )
