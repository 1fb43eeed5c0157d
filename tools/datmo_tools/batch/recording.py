# SPDX-License-Identifier: BSD-3-Clause
"""Processes one recording of a batch: run_bag, score_run, and the outcome as one file."""

import argparse
import contextlib
import errno
import json
import os
import resource
import sys
import tempfile
import time
from pathlib import Path

from datmo_tools import command_line, programs
from datmo_tools.batch.moments import worst_moments
from datmo_tools.errors import InputError
from datmo_tools.programs import StepFailed
from datmo_tools.text_table import one_line
from datmo_tools.whole_files import write_file

FORMAT = 1  # of the outcome
# What our programs say after the name of a file that they could not write. The reason that follows is
# rosbag's or iostream's, and of a full disk there are several: a write, a flush or a seek may fail first.
NOT_WRITTEN = ": cannot be written"
# In the language of LC_ALL=C, which programs.call() sets, and which os.strerror() has as long as
# nothing calls locale.setlocale().
DISK_FAULTS = (os.strerror(errno.ENOSPC), os.strerror(errno.EDQUOT), os.strerror(errno.EIO))
SCORES = ("clear_mot", "identity", "hota", "errors", "pose")  # of score_run, copied to an outcome


class Unfinished(InputError):
    """The failure is not the recording's fault: the job has to run again."""


def main(arguments=None):
    """Runs the command line; returns its exit code, 0 even if the recording cannot be used."""
    parser = argparse.ArgumentParser(prog="batch.recording", description=__doc__)
    parser.add_argument("settings", type=Path)
    parser.add_argument("outcome", type=Path)
    values = parser.parse_args(arguments)
    settings = json.loads(values.settings.read_text())
    return command_line.run("batch", lambda: process(settings, values.outcome), "outcome")


def process(settings, outcome):
    """Writes the outcome (Path), a JSON file, and next to it the bag and the score.

    Everything is created in this attempt's own folder, so that attempts whose jobs were killed, or
    that still run on another machine, do not interfere.
    """
    started = time.monotonic()
    work = outcome.parent.parent / "work"
    try:
        work.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=settings["id"] + ".", dir=work) as folder:
            result = {"format": FORMAT, "id": settings["id"], "name": settings["name"],
                      **_run_and_score(settings, Path(folder))}  # fmt: skip
            result["took"] = {"wall_s": time.monotonic() - started, "processor_s": _processor_time()}
            _keep(settings, Path(folder), outcome)
        write_file(outcome, json.dumps(result, indent=1) + "\n")
    except (OSError, InputError) as error:
        with contextlib.suppress(OSError):
            cause_file(outcome.parent.parent, settings["id"]).write_text(str(error))
        raise Unfinished(f"{settings['name']}: {error}") from error
    print(f"batch: {one_line(line(result))}", file=sys.stderr)


def cause_file(out, recording):
    """Returns the path of the file with the reason why a recording's (id) last attempt gave up."""
    return out / "work" / f"{recording}.unfinished"


def line(result):
    """Returns the outcome of a recording as a line for the console."""
    if result["error"]:
        return f"{result['name']}: {result['error']}"
    mota = ((result["score"] or {}).get("clear_mot") or {}).get("mota")
    return f"{result['name']}: {result['run']['duration_s']:.1f} s" + (
        "" if mota is None else f", MOTA {100.0 * mota:.1f} %")  # fmt: skip


def _run_and_score(settings, folder):
    result = {"error": None, "run": None, "score": None, "score_error": None, "moments": []}
    tools = Path(settings["programs"])
    bag, report, score = folder / "result.bag", folder / "report.json", folder / "score.json"
    try:
        _call(tools / "run_bag", settings["bag"], bag, "--config", settings["config"], "--report",
              report, "--with-truth", "--quiet", "--jobs", 1, *settings["options"])  # fmt: skip
    except StepFailed as error:
        return {**result, "error": str(error)}
    result["run"] = json.loads(report.read_text())
    whole = None
    if settings["truth"] or result["run"]["has_truth"]:
        truth = [settings["truth"]] if settings["truth"] else []
        try:
            _call(tools / "score_run", bag, *truth, "--out", score)
            whole = json.loads(score.read_text())
            result["score"] = {key: whole[key] for key in SCORES}
        except StepFailed as error:
            result["score_error"] = str(error)
    result["moments"] = worst_moments(result["run"], whole)
    return result


def _call(program, *words):
    """Like programs.call(), but raises Unfinished if the recording is not to blame."""
    try:
        programs.call(program, *words)
    except OSError as error:
        raise Unfinished(f"{program} cannot be started: {error}") from error
    except StepFailed as error:
        if error.code < 0:
            raise Unfinished(str(error)) from error
        faults = (*DISK_FAULTS, *(f"{word}{NOT_WRITTEN}" for word in words))
        if any(fault in str(error) for fault in faults):
            raise Unfinished(f"{error}: the disk is full or broken") from error
        raise


def _keep(settings, folder, outcome):
    """Gives the files their final names; the outcome comes last."""
    outcome.parent.mkdir(parents=True, exist_ok=True)
    kept = [("score.json", ".score.json")]
    if settings["keep_bags"]:
        kept.append(("result.bag", ".bag"))
    for name, suffix in kept:
        final = outcome.with_name(settings["id"] + suffix)
        if (folder / name).exists():
            os.replace(folder / name, final)
        else:
            final.unlink(missing_ok=True)  # of an earlier attempt, before something changed
    if not settings["keep_bags"]:
        outcome.with_name(settings["id"] + ".bag").unlink(missing_ok=True)


def _processor_time():
    """Returns the processor time (s) of this process and the programs that it called."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)
