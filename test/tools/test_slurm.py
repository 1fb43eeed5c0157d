#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The parts of a batch on Slurm, with stand-ins for its commands: states of jobs, and the profile."""

import contextlib
import io
import os
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from batch_case import BatchCase

from datmo_tools.batch import slurm_status
from datmo_tools.batch.main import PROFILES

JOB = "4711"
# Of Slurm's list of job states: those of a job that is not at its end, and those of one that is.
UNFINISHED = (
    "PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "STOPPED", "REQUEUED", "RESIZING",
    "SIGNALING", "STAGE_OUT",
)  # fmt: skip
ENDED = (
    "FAILED", "CANCELLED", "TIMEOUT", "OUT_OF_MEMORY", "NODE_FAIL", "PREEMPTED", "BOOT_FAIL", "DEADLINE",
)  # fmt: skip

# What the commands say about a job that they do not know, and where accounting is not set up.
NO_JOB = 'echo "slurm_load_jobs error: Invalid job id specified" >&2; exit 1'
NO_ACCOUNTING = 'echo "Slurm accounting storage is disabled" >&2; exit 1'
NO_ANSWER = 'echo "Unable to contact slurm controller (connect failure)" >&2; exit 1'

# Runs the job at once and keeps its state, which the job named in `fails_once` has changed before that.
SBATCH = """\
here=$(dirname "$0")
echo "$@" >> "$here/submissions"
number=$(wc -l < "$here/submissions")
for script; do :; done
if [ "$number" -le "$(cat "$here/lost")" ]; then state=OUT_OF_MEMORY; else
  state=COMPLETED; sh "$script" > "$here/job.$number" 2>&1 || state=FAILED
fi
echo "$state" > "$here/state.$number"
echo "$number"
"""
SACCT = 'for job; do :; done; cat "$(dirname "$0")/state.$job"'


class Commands:
    """A folder of stand-ins for Slurm's commands, the only one on PATH besides the system's."""

    def __init__(self, case):
        folder = tempfile.TemporaryDirectory()
        case.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, **scripts):
        for name, script in scripts.items():
            path = self.folder / name
            path.write_text("#!/bin/sh\n" + script + "\n")
            path.chmod(0o755)

    def on_path(self):
        """Returns a context manager."""
        return mock.patch.dict(os.environ, PATH=f"{self.folder}:{os.environ['PATH']}")


class States(unittest.TestCase):
    def state(self, **scripts):
        """Returns what is reported with these commands (name -> script); others are missing."""
        commands = Commands(self)
        commands.write(**scripts)
        out = io.StringIO()
        with commands.on_path(), contextlib.redirect_stdout(out), \
             mock.patch.object(sys, "argv", ["slurm_status", JOB]):  # fmt: skip
            self.assertEqual(slurm_status.main(), 0)
        return out.getvalue()

    def assert_state(self, state, expected):
        """By the accounting, and by the controller where there is none."""
        with self.subTest(state=state):
            self.assertEqual(self.state(sacct=f'echo "{state}"', scontrol=NO_ANSWER), expected + "\n")
            shown = f'echo "JobId={JOB} JobName=datmo-a UserId=me(1) JobState={state} Reason=None"'
            for sacct in (NO_ACCOUNTING, "exit 0"):  # an empty list: not accounted yet
                self.assertEqual(self.state(sacct=sacct, scontrol=shown), expected + "\n")
            self.assertEqual(self.state(scontrol=shown), expected + "\n")

    def test_completed(self):
        self.assert_state("COMPLETED", "success")

    def test_not_at_its_end(self):
        for state in UNFINISHED:
            self.assert_state(state, "running")

    def test_ended_without_success(self):
        for state in ENDED:
            self.assert_state(state, "failed")
        self.assertEqual(self.state(sacct='echo "CANCELLED by 1000"'), "failed\n")

    def test_a_forgotten_job_has_ended(self):
        for sacct in ("exit 0", NO_ACCOUNTING):
            self.assertEqual(self.state(sacct=sacct, scontrol=NO_JOB), "failed\n")

    def test_without_an_answer_snakemake_has_to_ask_again(self):
        self.assertEqual(self.state(), "running\n")
        self.assertEqual(self.state(sacct=NO_ANSWER, scontrol=NO_ANSWER), "running\n")
        self.assertEqual(self.state(sacct="exit 0", scontrol='echo "no state in here"'), "running\n")

    def test_the_job_is_the_one_that_is_asked_for(self):
        said = 'for word; do :; done; [ "$word" = 4711 ] && echo COMPLETED || echo FAILED'
        self.assertEqual(self.state(sacct=said), "success\n")


class Profile(BatchCase):
    def setUp(self):
        super().setUp()
        self.commands = Commands(self)
        self.commands.write(sbatch=SBATCH, sacct=SACCT, scancel="exit 0")
        self.lose(0)

    def lose(self, number):
        """Makes Slurm end the first `number` jobs before they start."""
        (self.commands.folder / "lost").write_text(str(number))

    def submissions(self):
        return (self.commands.folder / "submissions").read_text().splitlines()

    def test_no_profile_is_without_a_test(self):
        profiles = sorted(path.name for path in PROFILES.iterdir() if path.is_dir())
        self.assertEqual(profiles, ["local", "slurm"])  # test_batch runs by the first one, this file by the other

    def test_jobs_are_submitted_asked_about_and_submitted_again(self):
        self.drives = self.folder / "it's; touch pwned {x}"
        self.drives.mkdir()
        self.record(a="good")
        self.lose(1)
        # CI: Snakemake asks about its jobs every second instead of every ten.
        with self.commands.on_path(), mock.patch.dict(os.environ, CI="true"):
            code, said, report = self.batch("--profile", "slurm")
        self.assertEqual(code, 0, said)
        self.assertEqual(report["totals"]["recordings"], 1)
        self.assertEqual(self.starts(), ["a.bag"])
        submissions = self.submissions()
        self.assertEqual(len(submissions), 2, said)
        for line in submissions:
            self.assertRegex(line, r"--mem=\d+ --time=\d+ --job-name=datmo-a-[0-9a-f]{8} ")
        self.assertEqual(list(self.folder.rglob("pwned")), [])

    def test_a_folder_whose_name_snakemake_would_run_is_refused(self):
        for name in ("$(touch pwned)", "`touch pwned`", '"; touch pwned; "', "back\\slash"):
            with self.subTest(name=name):
                self.drives = self.folder / name
                self.drives.mkdir()
                self.record(a="good")
                with self.commands.on_path():
                    code, said, report = self.batch("--profile", "slurm")
                self.assertEqual((code, report), (1, None))
                self.assertIn(f"{self.drives / 'batch'}: a job of Snakemake cannot have", said)
                self.assertEqual(list(self.folder.rglob("pwned")), [])


if __name__ == "__main__":
    unittest.main()
