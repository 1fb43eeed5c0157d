#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate calibrate_object_covariance on small bags of known variance."""

import contextlib
import io
import json
import math
import tempfile
import unittest
from pathlib import Path

import numpy as np
import yaml
from datmo_tools import bag_messages
from datmo_tools.bag_file import whole_bag
from datmo_tools.evaluate.main import main
from geometry_msgs.msg import Point, Pose, Pose2D, Quaternion, Vector3

from datmo_fusion.msg import FieldOfView, ObjectArray, Track, TrackArray
from object_samples import object_at

MILLISECOND = 10**6
START = 1000 * 10**9


class Tool(unittest.TestCase):
    """A vehicle that drives at 10 m/s, and oncoming cars, seen by a scanner and a camera.

    The camera is 1.5 m ahead, and is exposed 30 ms after the scan; the scan reaches the cars after
    20 ms.
    """

    CAMERA = np.array([1.5, 0.0])  # m
    SPEED, CAR_SPEED = 10.0, -8.0  # m/s
    ROUND = 0.2  # s: two scans; then the cars are where they were relative to the vehicle

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.bag, self.out = self.root / "run.bag", self.root / "table.yaml"

    def write(self, *topics, rounds=50, range_sigma=0.3, across_sigma=0.05):
        """Writes a bag with lists on the topics: two scans each round,
        and an image between them."""
        noise = np.random.Generator(np.random.PCG64(1)).standard_normal((rounds, 10, 2)) * [range_sigma, across_sigma]
        with whole_bag(self.bag, "test") as bag:
            for i in range(2 * rounds):
                stamp = START + i * 100 * MILLISECOND
                pose = [self.SPEED * 0.1 * i, 0.0, 0.0]
                message = bag_messages.planar_odometry(stamp, "map", "base_link", pose, 0.0, 0.0)
                bag.write("/pose", stamp, message)
                bag.write("/tracks", stamp, self.tracks(stamp, pose[0]))
                if "/objects" in topics:
                    bag.write("/objects", stamp, self.seen(stamp, 0.02, np.zeros((10, 2))))
                if "/objects/stereo" in topics and i % 2 == 0:
                    stamp += 30 * MILLISECOND
                    message = self.seen(stamp, 0.0, noise[i // 2])
                    message.views = [FieldOfView(sensor="stereo", pose=Pose2D(*self.CAMERA, 0.0))]
                    bag.write("/objects/stereo", stamp, message)

    def seen(self, stamp, delay, offsets):
        """Ten cars at 6 m to 24 m, one beside the other, as seen `delay` (s) after the stamp.

        offsets: 10 x 2, m, along and across the line of sight.
        """
        items = []
        for i, offset in enumerate(offsets):
            ray = np.array([self.ahead(stamp, i, delay), 3.0 * i - 13.5]) - self.CAMERA
            along = ray / np.hypot(*ray)
            across = np.array([-along[1], along[0]])
            near = self.CAMERA + ray + offset[0] * along + offset[1] * across
            items.append(object_at(near[0] + 2.0, near[1], yaw=math.pi, delay=delay, variance=1e-6))
        return ObjectArray(header=bag_messages.header(stamp, "base_link"), objects=items)

    def tracks(self, stamp, distance):
        """Returns all cars, half a meter off; distance: driven, m."""
        tracks = []
        for i in range(10):
            middle = Point(distance + self.ahead(stamp, i) + 2.5, 3.0 * i - 13.5, 0.0)
            position = Pose(middle, Quaternion(0.0, 0.0, 0.0, 1.0))
            tracks.append(Track(pose=position, size=Vector3(4.0, 1.8, 0.0), moving=True,
                                velocity=Vector3(self.CAR_SPEED, 0.0, 0.0)))  # fmt: skip
        return TrackArray(header=bag_messages.header(stamp, "map"), tracks=tracks)

    def ahead(self, stamp, number, delay=0.0):
        """Returns the range of a car's near side from the vehicle at a stamp,
        measured `delay` later."""
        since = (stamp - START) * 1e-9 % self.ROUND
        return 6.5 + 2.0 * number + self.CAR_SPEED * (since + delay) - self.SPEED * since

    def calibrate(self, *words, code=0, runs=None):
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            given = runs or [str(self.bag)]
            arguments = ["calibrate_object_covariance", *given, "--out", str(self.out), "--range", "26", *words]
            self.assertEqual(main(arguments), code, errors.getvalue())
        return out.getvalue(), errors.getvalue()

    def table(self, source="stereo"):
        read = yaml.safe_load(self.out.read_text())
        return read["object_fusion"]["sources"][source]["covariance"]

    def test_motion_of_vehicle_and_cars_is_compensated(self):
        """Without the vehicle's motion the camera would be 0.3 m off,
        without the cars' motion 0.1 m."""
        self.write("/objects", "/objects/stereo", rounds=100)
        score = self.root / "score.json"
        self.calibrate("--json", str(score))
        table, figures = self.table(), json.loads(score.read_text())
        self.assertEqual(table["bin_width"], 2.0)
        self.assertEqual(len(table["range_variance"]), 13)
        measured = [i for i, known in enumerate(figures["range"]["measured"]) if known]
        self.assertGreater(len(measured), 5)
        for i in measured:
            count = figures["range"]["count"][i]
            self.assertLess(abs(figures["range"]["bias"][i]), 4.0 * 0.3 / math.sqrt(count))
            tolerance = 4.0 * math.sqrt(2.0 / count)
            self.assertLess(abs(table["range_variance"][i] / 0.09 - 1.0), tolerance)
            across = math.sqrt(table["bearing_variance"][i]) * (2.0 * i + 1.0)
            self.assertTrue(0.03 < across < 0.08, across)

    def test_two_bags_are_pooled(self):
        self.write("/objects", "/objects/stereo", rounds=20)
        paired = []
        for runs in ([str(self.bag)], [str(self.bag)] * 2):
            score = self.root / "score.json"
            self.calibrate("--json", str(score), "--min-pairs", "5", runs=runs)
            paired.append(json.loads(score.read_text())["objects"]["paired"])
        self.assertEqual(paired[1], 2 * paired[0])
        self.assertGreater(paired[0], 0)

    def test_plots(self):
        self.write("/objects", "/objects/stereo", rounds=20)
        words = ("--min-pairs", "10", "--source", "other")
        starts = {"a.svg": b"<?xml", "b.svg": b"<?xml", "a.pdf": b"%PDF", "a.png": b"\x89PNG"}
        for name, start in starts.items():
            self.calibrate("--plot", str(self.root / name), *words)
            self.assertTrue((self.root / name).read_bytes().startswith(start), name)
        self.assertEqual(*((self.root / f"{name}.svg").read_bytes() for name in "ab"))
        self.assertIn("range_variance", self.table("other"))
        said = self.calibrate("--plot", "plot.gif", code=1)[1]
        self.assertIn("plot.gif: expected a name that ends in .svg, .pdf, .png", said)

    def test_bag_without_one_sensor(self):
        self.write("/objects/stereo", rounds=2)
        self.assertIn("nothing on /objects, expected a bag of run_bag", self.calibrate(code=1)[1])
        self.write("/objects", rounds=2)
        self.assertIn("nothing on /objects/stereo", self.calibrate(code=1)[1])
        said = self.calibrate("--stereo", "/objects", "--tracks", "/none", code=1)[1]
        self.assertIn("nothing that moves on /none", said)
        self.assertFalse(self.out.exists())

    def test_few_pairs(self):
        self.write("/objects", "/objects/stereo", rounds=2)
        self.assertIn("expected two bins", self.calibrate(code=1)[1])

    def test_bad_options(self):
        self.assertIn("--bin-width is 0", self.calibrate("--bin-width", "0", code=1)[1])
        said = self.calibrate("--bin-width", "30", code=1)[1]
        self.assertIn("--range is 26, expected more than --bin-width, 30", said)


if __name__ == "__main__":
    unittest.main()
