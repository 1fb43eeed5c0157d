"""Calls score_run, which scores one run, and reads what it wrote."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

from datmo_tools import programs
from datmo_tools.errors import InputError

FORMAT = 1  # of score_run's JSON that is understood here


def find_score_run(beside=None):
    """Path of the program score_run, as programs.find looks for it. beside: default sys.argv[0]."""
    return programs.find("score_run", beside or sys.argv[0])


def score(program, run, truth, settings):
    """Dictionary that `program` writes on the bag `run`.

    truth: bag with the truth, or None where the run's holds it; settings: words for the command
    line of score_run. Where it fails it has said why: its exit code becomes ours (SystemExit).
    """
    bags = [str(run)] if truth is None else [str(run), str(truth)]
    with tempfile.TemporaryDirectory(prefix="evaluate_") as folder:
        report = Path(folder) / "score.json"
        done = subprocess.run([program, *bags, *settings, "--out", str(report)], check=False)
        if done.returncode != 0:
            raise SystemExit(done.returncode if done.returncode > 0 else 1)
        scored = json.loads(report.read_text(encoding="utf-8"))
    if scored["format"] != FORMAT:
        raise InputError(f"{program} writes format {scored['format']}, expected {FORMAT}")
    return scored
