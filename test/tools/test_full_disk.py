#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The disk is really full: the built programs fail in a batch whose attempts are on a tiny file system.

The small disks are mounted in a namespace of their own, which not every container permits; then those
tests are skipped. test_batch has a full disk that needs no rights.
"""

import functools
import json
import os
import resource
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from batch_case import why_not

from datmo_tools.batch.plan import find_recordings, write_plan
from datmo_tools.batch.recording import cause_file

REPOSITORY = Path(__file__).resolve().parents[2]
SCENE = REPOSITORY / "rosbag_fixtures" / "scenes" / "intersection.yaml"
CONFIG = REPOSITORY / "config" / "demonstrator.yaml"
PROGRAMS = Path(os.environ["RUN_BAG"]).parent
DURATION = 1.5  # s, of the drive
PAGE = os.sysconf("SC_PAGE_SIZE")  # bytes: what a tmpfs is made of
TIMEOUT = 120.0  # s, of a call that takes a few
IN_NAMESPACE = ["unshare", "--map-root-user", "--mount"]
OVER = "the disk is full or broken"


def why_no_small_disk():
    """Returns why no small file system can be mounted; empty if one can."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([*IN_NAMESPACE, "sh", "-c", mount(folder, PAGE)], check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")  # fmt: skip
    return f"skipped: no small file system can be mounted: {done.stdout}" if done.returncode else ""


def mount(folder, size):
    """Returns the shell command that mounts a file system of this size (bytes) on a folder."""
    return f"mount -t tmpfs -o size={size} none {shlex.quote(str(folder))}"


class FullDiskCase(unittest.TestCase):
    """A recording with ground truth, and a batch's folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.drives = Path(folder.name) / "drives"
        self.out = self.drives / "batch"
        self.drives.mkdir()
        subprocess.run([PROGRAMS / "simulate", SCENE, self.drives / "a.bag", "--quiet", "--set",
                        f"duration={DURATION}"], check=True, timeout=TIMEOUT)  # fmt: skip
        self.recordings = find_recordings(self.drives, self.out, CONFIG)
        self.id = self.recordings[0].id

    def call(self, *words, disk=None, most=None):
        """Runs a tool. disk: size (bytes) of the file system below the attempts; most: size (bytes)
        that the system permits a file."""
        words = [sys.executable, "-m", "datmo_tools", *map(str, words)]
        if disk is not None:
            work = self.out / "work"
            work.mkdir(parents=True, exist_ok=True)
            words = [*IN_NAMESPACE, "sh", "-c", f"{mount(work, disk)} && exec {shlex.join(words)}"]
        limit = None
        if most is not None:
            limit = functools.partial(resource.setrlimit, resource.RLIMIT_FSIZE, (most, most))
        return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8",
                              check=False, timeout=TIMEOUT, preexec_fn=limit)  # fmt: skip

    def attempt(self, **limits):
        """Returns the exit code of one attempt and what it said."""
        write_plan(self.out, self.recordings, PROGRAMS, [], True)
        done = self.call("batch.recording", self.out / "settings" / f"{self.id}.json",
                         self.outcome(), **limits)  # fmt: skip
        return done.returncode, done.stderr

    def outcome(self):
        return self.out / "recordings" / f"{self.id}.json"

    def sizes(self):
        """Returns the sizes (bytes) of what an attempt writes: the bag, and all files."""
        code, said = self.attempt()
        self.assertEqual(code, 0, said)
        bag, score = self.outcome().with_suffix(".bag"), self.outcome().with_suffix(".score.json")
        sizes = bag.stat().st_size, score.stat().st_size
        for path in (bag, score, self.outcome()):
            path.unlink()
        return sizes


@unittest.skipIf(why_no_small_disk(), why_no_small_disk())
class FullDisk(FullDiskCase):
    def test_every_size_is_reported_and_none_blames_the_recording(self):
        bag, score = self.sizes()
        # The bag cannot be begun, continued or finished; the report or the score has no room.
        for size in (PAGE, bag // 2, bag - PAGE, bag + PAGE, bag + PAGE + score // 2):
            with self.subTest(size=size, bag=bag, score=score):
                code, said = self.attempt(disk=size)
                blamed = self.outcome().exists()
                self.outcome().unlink(missing_ok=True)
                self.assertFalse(blamed, said)
                self.assertEqual(code, 1)
                self.assertIn(OVER, said)
                self.assertEqual(len(said.splitlines()), 1, said)
        # With enough room only the move from this file system to the results' own fails.
        _, said = self.attempt(disk=bag + score + 8 * PAGE)
        self.assertIn("Invalid cross-device link", said)

    @unittest.skipIf(why_not(), why_not())
    def test_the_report_says_so_and_the_same_command_resumes(self):
        bag, _ = self.sizes()
        words = ["batch.main", self.drives, "--config", CONFIG, "--programs", PROGRAMS, "--jobs", "1"]
        done = self.call(*words, disk=bag // 2)
        self.assertEqual(done.returncode, 1, done.stderr)
        failed = json.loads((self.out / "batch.json").read_text())["failed"]
        self.assertEqual([(one["name"], one["finished"]) for one in failed], [("a.bag", False)])
        self.assertIn("is full", (self.out / "batch.html").read_text())
        done = self.call(*words)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class LimitedFiles(FullDiskCase):
    """`ulimit -f`, which clusters set: the system ends the program that writes more."""

    def test_it_is_named_and_the_recording_is_not_blamed(self):
        code, said = self.attempt(most=16 * PAGE)
        self.assertEqual(code, 1)
        self.assertRegex(said, "run_bag: ended by signal .*File size limit exceeded")
        self.assertFalse(self.outcome().exists())
        self.assertIn("File size limit", cause_file(self.out, self.id).read_text())


if __name__ == "__main__":
    unittest.main()
