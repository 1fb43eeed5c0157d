# SPDX-License-Identifier: BSD-3-Clause
"""Stores the steps that are done at a commit, and the one file of figures made from them."""

import datetime
import json
import os
import platform
import re
import subprocess
from pathlib import Path

from datmo_tools.errors import InputError
from datmo_tools.spread import rounded
from datmo_tools.figures.step import read_json
from datmo_tools.whole_files import write_file, write_whole

FORMAT = 1
CHANGED = "-changed"  # suffix of a commit's name if the sources have been changed since
# Everything except what no figure depends on.
SOURCES = (".", ":(exclude)README.md", ":(exclude)CHANGELOG.rst", ":(exclude)doc", ":(exclude)test")
LIST_OF_NUMBERS = re.compile(r"\[\s+((?:[-+.\deE]+|null)(?:,\s+(?:[-+.\deE]+|null))*)\s+\]")


def commit_of(source):
    """Returns the abbreviated last commit of SOURCES in a checkout (Path). Raises InputError."""
    name = _git(source, "log", "-1", "--abbrev=8", "--format=%h", "--", *SOURCES)
    changes = _git(source, "status", "--porcelain", "--", *SOURCES)
    return name + (CHANGED if changes else "")


def _git(source, *words):
    done = subprocess.run(["git", "-C", str(source), *words], check=False, capture_output=True,
                          encoding="utf-8")  # fmt: skip
    if done.returncode != 0:
        raise InputError(f"{source}: no git commit, expected a git checkout: {done.stderr}")
    return done.stdout.strip()


class StepStore:
    """A file for each step, and for each of its jobs, that is done at a commit. With changed
    sources, none counts as done, and the results are those of this run alone."""

    def __init__(self, folder, commit):
        """folder (Path): for all commits."""
        self.folder, self.commit = folder / commit, commit
        self._added = set()  # names of steps, by this run

    def is_done(self, step, bench):
        """Whether the step need not run again."""
        file = self._file(step.name)
        if self.commit.endswith(CHANGED) or not file.is_file():
            return False
        return read_json(file)["seeds"] == _seeds(step, bench)

    def of_job(self, step, name):
        """Returns what add_job() stored of a job: (result, s); None if it has to run."""
        file = self._job_file(step, name)
        if self.commit.endswith(CHANGED) or not file.is_file():
            return None
        kept = read_json(file)
        return kept["result"], kept["seconds"]

    def add_job(self, step, name, result, seconds):
        """Stores a job's result, so that an interrupted step continues with the next one."""
        file = self._job_file(step, name)
        write_file(file, json.dumps({"result": result, "seconds": seconds}))

    def add(self, step, figures, seconds, bench):
        """Stores a step's result; seconds: of all its jobs."""
        record = {
            "shows": step.shows,
            "command": step.command,
            "seeds": _seeds(step, bench),
            "date": datetime.datetime.now(datetime.timezone.utc).date().isoformat(),
            "job_seconds": round(seconds),
            "figures": rounded(figures),
        }
        write_whole(self.folder, {f"{step.name}.json": json.dumps(record) + "\n"})
        self._added.add(step.name)

    def results(self, steps):
        """Returns all steps that are done (dict), in the order of `steps`; None without any."""
        done = {step.name: read_json(self._file(step.name)) for step in steps if self._counts(step.name)}
        if not done:
            return None
        date = max(step["date"] for step in done.values())
        return {"format": FORMAT, "commit": self.commit, "date": date, "machine": machine(),
                "steps": done}  # fmt: skip

    def _counts(self, name):
        """Whether a step's file is of these sources: a former run may have had other changes."""
        return name in self._added if self.commit.endswith(CHANGED) else self._file(name).is_file()

    def _job_file(self, step, name):
        return self.folder / "jobs" / step.name / f"{name}.json"

    def _file(self, name):
        return self.folder / f"{name}.json"


def _seeds(step, bench):
    return list(bench.seeds) if step.seeded else None


def machine():
    """Returns processor and number of cores, for the figures of speed."""
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return {"processor": names[0] if names else platform.machine(), "cores": os.cpu_count()}


def as_text(results):
    """Returns JSON with a line for each figure, and lists of numbers on one line."""
    text = json.dumps(results, indent=1, ensure_ascii=False) + "\n"
    return LIST_OF_NUMBERS.sub(lambda found: "[" + re.sub(r"\s+", " ", found[1]) + "]", text)


def read(file):
    """Returns the file of figures (dict). Raises InputError."""
    try:
        results = read_json(file)
    except (OSError, ValueError) as error:
        raise InputError(f"{file}: cannot be read: {error}; scripts/figures makes it") from error
    if results.get("format") != FORMAT:
        raise InputError(f"{file}: format {results.get('format')}, expected {FORMAT}")
    return results
