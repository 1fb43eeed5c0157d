# SPDX-License-Identifier: BSD-3-Clause
"""Stores the steps that are done at a commit, and the one file of figures made from them."""

import datetime
import json
import os
import platform
import re
import shutil
from pathlib import Path

from datmo_tools.errors import InputError
from datmo_tools.figures import sample
from datmo_tools.figures.commits import CHANGED
from datmo_tools.figures.step import read_json
from datmo_tools.spread import rounded
from datmo_tools.whole_files import write_file

FORMAT = 1
LIST_OF_NUMBERS = re.compile(r"\[\s+((?:[-+.\deE]+|null)(?:,\s+(?:[-+.\deE]+|null))*)\s+\]")


class StepStore:
    """A file for each step, and for each of its jobs, that is done at a commit, and the steps that
    were done before and are not affected by what has changed since, or whose sample shows no effect.
    Times count only on the machine that they are of. With changed sources, no step counts as done,
    and the results are those of this run alone."""

    def __init__(self, folder, commit, unaffected=None, affected=None):
        """folder (Path): for all commits; unaffected, affected: records of steps, as in Earlier."""
        self.folder, self.commit = folder / commit, commit
        self._earlier = unaffected or {}
        self._changed = commit.endswith(CHANGED)  # a former run may have had other changes
        for name, record in (affected or {}).items():  # a run that leaves a step out must not lose its record
            write_file(self.folder / "affected" / f"{name}.json", json.dumps(record))
        self._added = set()  # names of steps, by this run

    def forget(self, step):
        """Removes what is stored of a step, so that it has to run, also after an interruption."""
        jobs = self._job_file(step, "any").parent
        if jobs.exists():
            shutil.rmtree(jobs)
        self._write(step, None)  # in place of the earlier record, which counts without a file

    def done_at(self, step, bench):
        """Returns the commit at which the step was measured; None if it has to run."""
        record = None if self._changed else self._record(step)
        return record["commit"] if record and record["seeds"] == _seeds(step, bench) else None

    def sample_of(self, step, bench):
        """Returns the job (name) whose result tells whether a step that was affected by a change has to
        run; None if it has to anyway."""
        record = None if self._changed or self._file(step).is_file() else self._affected(step)
        is_usable = record and not step.timed and record["seeds"] == _seeds(step, bench)
        return sample.drawn(record, self.commit, {job.name for job in step.jobs(bench)}) if is_usable else None

    def confirm(self, step, job, result):
        """Keeps the step as it was measured before if this job's result is the same. Returns whether
        it is."""
        record = self._affected(step)
        is_same = sample.digest(result) == record["jobs"][job]
        if is_same:
            self._write(step, {**record, "confirmed": {"commit": self.commit, "job": job}})
        return is_same

    def _affected(self, step):
        """Returns the record of a step that a change may have affected; None without one."""
        file = self.folder / "affected" / f"{step.name}.json"
        return read_json(file) if file.is_file() else None

    def of_job(self, step, name):
        """Returns what add_job() stored of a job: (result, s); None if it has to run."""
        file = self._job_file(step, name)
        if self._changed or not file.is_file():
            return None
        kept = read_json(file)
        return (kept["result"], kept["seconds"]) if _counts_here(step, kept) else None

    def add_job(self, step, name, result, seconds):
        """Stores a job's result, so that an interrupted step continues with the next one."""
        file = self._job_file(step, name)
        write_file(file, json.dumps({"result": result, "seconds": seconds, "machine": machine()}))

    def add(self, step, figures, jobs, bench):
        """Stores a step's figures; jobs: name -> (result, s)."""
        record = {
            "shows": step.shows,
            "command": step.command,
            "seeds": _seeds(step, bench),
            "commit": self.commit,
            "date": datetime.datetime.now(datetime.timezone.utc).date().isoformat(),
            "machine": machine(),
            "job_seconds": round(sum(seconds for _, seconds in jobs.values())),
            "jobs": {name: sample.digest(jobs[name][0]) for name in sorted(jobs)},
            "figures": rounded(figures),
        }
        self._write(step, record)
        self._added.add(step.name)

    def results(self, steps):
        """Returns all steps that are done (dict), in the order of `steps`; None without any."""
        found = {step.name: self._record(step) for step in steps}
        done = {name: record for name, record in found.items() if record}
        if not done:
            return None
        date = max(step["date"] for step in done.values())
        return {"format": FORMAT, "commit": self.commit, "date": date, "machine": machine(),
                "steps": done}  # fmt: skip

    def _record(self, step):
        """Returns a step's record of these sources (dict); None without one."""
        if self._changed and step.name not in self._added:
            return None
        file = self._file(step)
        record = read_json(file) if file.is_file() else self._earlier.get(step.name)
        if not record or not _counts_here(step, record):
            return None
        return {"confirmed": None, **record}  # at which later commit, and by which job

    def _write(self, step, record):
        write_file(self._file(step), json.dumps(record) + "\n")

    def _file(self, step):
        return self.folder / f"{step.name}.json"

    def _job_file(self, step, name):
        return self.folder / "jobs" / step.name / f"{name}.json"


def last_commit(record):
    """Returns the last commit at which a step's figures (record) are known to be the same."""
    return (record.get("confirmed") or record)["commit"]


def _seeds(step, bench):
    return list(bench.seeds) if step.seeded else None


def _counts_here(step, stored):
    """stored: a step's record, or a job's."""
    return not step.timed or stored["machine"] == machine()


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
    for record in results["steps"].values():
        for key in ("commit", "machine"):  # in older files the same for all steps
            record.setdefault(key, results[key])
    return results
