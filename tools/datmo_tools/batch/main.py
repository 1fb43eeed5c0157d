# SPDX-License-Identifier: BSD-3-Clause
"""Runs all recordings of a folder through the stack: command line, and start of Snakemake."""

import contextlib
import fcntl
import functools
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from datmo_tools import command_line, programs
from datmo_tools.batch import summary
from datmo_tools.batch.plan import find_recordings, write_plan
from datmo_tools.batch.recording import cause_file
from datmo_tools.errors import InputError
from datmo_tools.evaluate import report

DESCRIPTION = """\
Runs every recording (*.bag) of a folder through run_bag and, if its truth is in it or next to it
(NAME.truth.bag), score_run; writes batch.html and batch.json, with the worst moments of all first.
A restart resumes, and repeats only what has changed: recordings, sensor set, options,
programs. A recording that cannot be used is one line in the report, and the others continue; the
exit code is then 1. Words after -- are options of run_bag for all recordings."""

HERE = Path(__file__).parent
PROFILES = HERE / "profiles"
MIN_VERSION = 7  # of Snakemake
NEEDED = ("run_bag", "score_run", "check_configuration")
UNQUOTED = re.compile(r'["$`\\]')  # what a shell replaces, or ends at, between double quotes
MIN_FREE = 64 * 2**20  # bytes: with less, the disk counts as full


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    words = sys.argv[1:] if arguments is None else arguments
    # argparse takes what follows "--" as the last positional argument only if FOLDER is next to it.
    end = words.index("--") if "--" in words else len(words)
    values = _parser().parse_args(words[:end])
    values.options = words[end + 1:]
    complete = []
    code = command_line.run("batch", lambda: complete.append(_batch(values)), "report")
    return code or int(not complete[0])


def _batch(values):
    """Whether all recordings have been processed."""
    programs.check(values.programs, NEEDED)
    out = values.out if values.out is not None else values.folder / "batch"
    recordings = find_recordings(values.folder, out, values.config)
    for config in sorted({one.config for one in recordings}):
        try:
            programs.output_of(values.programs / "check_configuration", config)
        except programs.StepFailed as error:
            raise InputError(str(error)) from error
    with _locked(out):
        write_plan(out, recordings, values.programs, values.options, not values.no_bags)
        for one in recordings:
            cause_file(out, one.id).unlink(missing_ok=True)
        code = _snakemake(out, values)
        batch = summary.collect(out, recordings)
        _check_disk(out, batch)
        sections = summary.sections(batch)
        report.write(out, "batch", f"Batch of {len(recordings)} recordings", batch, sections)
        if code == 0:
            shutil.rmtree(out / "work", ignore_errors=True)  # of attempts whose jobs were killed
    print(report.as_text(sections))
    print(f"\nreport: {out / 'batch.html'}, {out / 'batch.json'}; Snakemake's log: {_log(out)}")
    return not batch["failed"]


@contextlib.contextmanager
def _locked(out):
    """Context manager that locks the folder against other batches; a killed one leaves no lock."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        with (out / "lock").open("w") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError as error:
                raise InputError(f"{out}: another batch is using it; wait until it ends") from error
            yield
    except OSError as error:
        raise InputError(f"{out}: cannot be written: {error}") from error


@functools.lru_cache(maxsize=1)
def find_snakemake():
    """Returns the path (str) of Snakemake. Raises InputError if it is missing or too old."""
    program = shutil.which("snakemake")
    if program is None:
        raise InputError("no snakemake on PATH, expected Debian's package snakemake"
                         " ('scripts/setup batch' installs it)")  # fmt: skip
    version = programs.output_of(Path(program), "--version").strip()
    if int(version.partition(".")[0]) < MIN_VERSION:
        raise InputError(f"{program} has version {version}, expected {MIN_VERSION} or newer")
    return program


def _snakemake(out, values):
    """Runs Snakemake and returns its exit code; it has ended when this returns, in any case."""
    program = find_snakemake()
    if values.profile != "local" and UNQUOTED.search(str(out.resolve())):
        # Snakemake puts the name of a job's script, which is below it, between double quotes.
        raise InputError(f"{out.resolve()}: a job of Snakemake cannot have \", $, ` or \\ in the name of"
                         " its folder, expected another one: --out DIR")  # fmt: skip
    profile = PROFILES / values.profile
    words = [program, "--snakefile", HERE / "Snakefile", "--directory", out, "--nolock", "--quiet",
             "--profile", profile if profile.is_dir() else values.profile]  # fmt: skip
    if values.jobs is not None:
        words += ["--jobs" if values.profile != "local" else "--cores", values.jobs]
    with _log(out).open("wb") as log, subprocess.Popen(
        [str(word) for word in words], stdout=log, stderr=subprocess.STDOUT, env=_environment()
    ) as process:
        try:
            return process.wait()
        except BaseException:
            process.terminate()  # Snakemake ends its jobs
            raise


def _environment():
    """Returns the environment of the jobs, in which they find this package as this process does."""
    path = [str(HERE.parent.parent), *filter(None, [os.environ.get("PYTHONPATH")])]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(path)}


def _log(out):
    return out / "snakemake.log"


def _check_disk(out, batch):
    """Raises InputError if the disk is too full for the remaining work."""
    undone = sum(not one["finished"] for one in batch["failed"])
    disk = os.statvfs(out)
    if undone and disk.f_bavail * disk.f_frsize < MIN_FREE:
        raise InputError(f"{out}: its disk is full, {undone} recordings remain; free space and run"
                         " the same command again, it resumes")  # fmt: skip


def _parser():
    parser = command_line.new_parser("batch", DESCRIPTION)
    add = parser.add_argument
    add("folder", type=Path, metavar="FOLDER", help="folder of recordings, subfolders included")
    add("--programs", required=True, type=Path, metavar="DIR",
        help="folder of run_bag and score_run")  # fmt: skip
    add("--config", type=Path, metavar="CONFIG.yaml",
        help="sensor set of recordings without one of their own (NAME.yaml)")  # fmt: skip
    add("--out", type=command_line.output_folder, metavar="DIR",
        help="report, scores and bags (default FOLDER/batch)")  # fmt: skip
    add("--profile", default="local", metavar="PROFILE",
        help="local, slurm, or a folder with a profile of Snakemake (default %(default)s)")  # fmt: skip
    add("--jobs", type=command_line.count, metavar="N",
        help="parallel recordings (default: the profile's)")  # fmt: skip
    add("--no-bags", action="store_true", help="keep only the scores, not the bags of results")
    parser.usage = parser.format_usage().removeprefix("usage: ").rstrip() + " [-- OPTION ...]"
    parser.epilog = "What follows -- are options of run_bag."
    return parser
