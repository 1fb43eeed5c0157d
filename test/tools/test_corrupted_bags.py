#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Corrupted recordings: refused in one line, or processed to finite numbers; never a crash.

DATMO_FUSION_BIT_FLIPS, DATMO_FUSION_DAMAGED_RANGES and DATMO_FUSION_FLIPPED_NUMBERS set how many are tried,
DATMO_FUSION_SEED which; doc/development.md has the long version.
"""

import contextlib
import io
import math
import os
import resource
import subprocess
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import genpy
import numpy as np
import rosbag
from bag_damage import chunks, flipped, with_damaged_range, with_flipped_number

from datmo_tools.check_bag.main import main as check_bag

REPOSITORY = Path(__file__).resolve().parents[2]
SCENE = REPOSITORY / "rosbag_fixtures" / "scenes" / "intersection.yaml"
CONFIG = REPOSITORY / "config" / "demonstrator.yaml"
DURATION = 1.5  # s, of the drive: the tracker has lists of tracks after a few scans
CHUNK_SIZE = 16 * 1024  # bytes: several chunks, as in a long recording
COMPRESSIONS = ("none", "lz4")

SEED = int(os.environ.get("DATMO_FUSION_SEED", "1"))
BIT_FLIPS = int(os.environ.get("DATMO_FUSION_BIT_FLIPS", "4"))
DAMAGED_RANGES = int(os.environ.get("DATMO_FUSION_DAMAGED_RANGES", "10"))
FLIPPED_NUMBERS = int(os.environ.get("DATMO_FUSION_FLIPPED_NUMBERS", "10"))

MAX_MEMORY = 4 * 2**30  # bytes of address space; an intact recording needs a fourth
MAX_SECONDS = 60.0  # an intact recording takes less than one
CODES = (0, 1, 2)  # doc/interfaces.md, Errors
# The topics whose numbers other programs rely on, and the field that may be infinite: Object.msg.
CHECKED_TOPICS = ("/pose", "/pose/local", "/tf", "/objects", "/tracks")
UNBOUNDED = "side_variance"


def limit():
    """Called in the new process: bounds its memory, and keeps a crash from writing a core file."""
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if not os.environ.get("DATMO_FUSION_SANITIZE"):  # the address sanitizer reserves terabytes
        resource.setrlimit(resource.RLIMIT_AS, (MAX_MEMORY, MAX_MEMORY))


def call(program, *words):
    return subprocess.run([os.environ[program], *map(str, words)], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, encoding="utf-8", errors="replace", check=False,
                          timeout=MAX_SECONDS, preexec_fn=limit)  # fmt: skip


def faults(value, name):
    """Yields what is wrong with the floating-point numbers of a message's field."""
    if isinstance(value, float):
        if math.isnan(value) or (math.isinf(value) and not name.endswith(UNBOUNDED)):
            yield f"{name} is {value}"
    elif isinstance(value, genpy.Message):
        for part in value.__slots__:
            yield from faults(getattr(value, part), f"{name}.{part}")
    elif isinstance(value, (list, tuple)):
        for item in value:
            yield from faults(item, name)


class CorruptedBags(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        drive = cls.folder / "drive.bag"
        done = call("SIMULATE", SCENE, drive, "--set", f"duration={DURATION}", "--quiet")
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        cls.intact = {compression: cls.sensors_of(drive, compression) for compression in COMPRESSIONS}
        drive.unlink()

    @classmethod
    def sensors_of(cls, drive, compression):
        """Returns the bytes of a bag with what a vehicle records, in several chunks."""
        path = cls.folder / "sensors.bag"
        with rosbag.Bag(str(drive)) as bag, rosbag.Bag(
            str(path), "w", compression=compression, chunk_threshold=CHUNK_SIZE
        ) as out:
            for topic, message, time in bag.read_messages():
                if not topic.startswith("/ground_truth"):
                    out.write(topic, message, time)
        content = path.read_bytes()
        path.unlink()
        return content

    def setUp(self):
        self.work = self.folder / self.id().rpartition(".")[2]
        self.work.mkdir()
        self.bag, self.out = self.work / "corrupted.bag", self.work / "result.bag"

    def check(self, content):
        """Calls check_bag, within bounded memory, on a bag (bytes), as judge()."""
        self.bag.write_bytes(content)
        out, errors = io.StringIO(), io.StringIO()
        limits = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (MAX_MEMORY, limits[1]))
        try:
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
                code = check_bag([str(self.bag), "--no-yaml"])
        finally:
            resource.setrlimit(resource.RLIMIT_AS, limits)
        self.assertIn(code, CODES)
        if code == 2:
            lines = [line for line in errors.getvalue().splitlines() if line.startswith("check_bag: ")]
            self.assertEqual(len(lines), 1, errors.getvalue())  # genpy may have written others before
            self.assertRegex(lines[0], r"corrupted\.bag: \S")
        return code

    def judge(self, content):
        """Runs run_bag on a bag (bytes); fails unless it refuses it in one line that names the file
        or a topic and leaves nothing behind, or writes a readable bag of finite numbers. Returns its
        exit code."""
        for left in self.work.iterdir():  # by one that failed
            left.unlink()
        self.bag.write_bytes(content)
        done = call("RUN_BAG", self.bag, self.out, "--config", CONFIG, "--quiet")
        self.assertIn(done.returncode, CODES, f"negative: the signal that ended it; it said: {done.stderr}")
        if done.returncode == 0:
            self.assert_finite()
            self.out.unlink()
        else:
            self.assert_clear(done.stderr)
        self.assertEqual([path.name for path in self.work.iterdir()], [self.bag.name])
        return done.returncode

    def assert_clear(self, said):
        # What roscpp logs comes first; a list of the topics may follow, indented.
        lines = [line for line in said.splitlines() if line.startswith("run_bag: ")]
        self.assertEqual(len(lines), 1, said)
        self.assertRegex(lines[0], r"corrupted\.bag: \S|corrupted\.bag to \S|/(echoes|odometry|tf)\b", said)

    def assert_finite(self):
        count = Counter()
        with rosbag.Bag(str(self.out)) as bag:
            for topic, message, _ in bag.read_messages():
                count[topic] += 1
                if topic in CHECKED_TOPICS:
                    self.assertEqual(list(faults(message, topic)), [])
        self.assertGreater(count["/pose"], 0)
        self.assertGreater(count["/tracks"], 0)

    def judge_all(self, number, damage, judge=None):
        """damage: function of the intact bag and the random numbers that returns a Damaged; judge:
        function of the damaged one (bytes) that returns an exit code."""
        codes = Counter()
        for index in range(number):
            compression = COMPRESSIONS[index % len(COMPRESSIONS)]
            damaged = damage(self.intact[compression], np.random.default_rng([SEED, index]))
            with self.subTest(seed=SEED, index=index, compression=compression, damage=damaged.what):
                codes[(judge or self.judge)(damaged.content)] += 1
        print(f"\nseed {SEED}, {number} corrupted recordings, by exit code: {dict(codes)}", flush=True)

    def test_intact_ones_are_accepted(self):
        for compression, content in self.intact.items():
            with self.subTest(compression=compression):
                self.assertGreater(len(chunks(content)), 3)
                self.assertEqual(self.judge(content), 0)

    def test_bit_flips(self):
        self.judge_all(BIT_FLIPS, flipped)

    def test_damaged_ranges(self):
        self.judge_all(DAMAGED_RANGES, with_damaged_range)

    def test_flipped_numbers(self):
        self.judge_all(FLIPPED_NUMBERS, with_flipped_number)

    def test_check_bag(self):
        for number, damage in ((BIT_FLIPS, flipped), (DAMAGED_RANGES, with_damaged_range),
                               (FLIPPED_NUMBERS, with_flipped_number)):  # fmt: skip
            self.judge_all(number, damage, self.check)


if __name__ == "__main__":
    unittest.main()
