#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""calibrate_object_covariance on synthetic pairs of known variance, and on small bags."""

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
from datmo_tools.evaluate.calibrate_object_covariance import main
from datmo_tools.evaluate.covariance_table import covariance_table, fitted_law, robust_spread
from datmo_tools.errors import InputError
from datmo_tools.evaluate.object_pairs import Pair
from geometry_msgs.msg import Point, Pose, Pose2D, Quaternion, Vector3

from datmo_fusion.msg import FieldOfView, ObjectArray, Track, TrackArray
from object_samples import object_at

MILLISECOND = 10**6
START = 1000 * 10**9

RANGE_LAW = (0.01, 1e-6)  # m^2 and m^-2: 0.1 m near, 1 m at 32 m
BEARING_LAW = (1e-5, 1e-2)  # rad^2 and m^2


def random():
    return np.random.Generator(np.random.PCG64(1))


def pairs(count=4000, lidar=(0.0, 0.0), bias=0.0, nearest=2.0, reach=30.0):
    """Pairs with the laws above; lidar: standard deviations of its range (m) and bearing (rad)."""
    generator = random()
    ranges = generator.uniform(nearest, reach, count)
    range_sigmas = np.sqrt(RANGE_LAW[0] + RANGE_LAW[1] * ranges**4 + lidar[0] ** 2)
    bearing_sigmas = np.sqrt(BEARING_LAW[0] + BEARING_LAW[1] / ranges**2 + lidar[1] ** 2)
    offsets = generator.standard_normal((2, count))
    columns = (ranges, offsets[0] * range_sigmas + bias, offsets[1] * bearing_sigmas)
    return [Pair(*map(float, row), lidar[0] ** 2, lidar[1] ** 2) for row in zip(*columns)]


class Table(unittest.TestCase):
    def assert_recovers(self, table, sigmas=4.0):
        """Each measured variance is that of the law, as sure as its number of pairs makes it."""
        for column, law in ((table.range, (*RANGE_LAW, 4)), (table.bearing, (*BEARING_LAW, -2))):
            # Within a bin ranges differ: the mean of the law over the bin is what is measured.
            edges = np.linspace(-1.0, 1.0, 21)
            within = table.centers[:, np.newaxis] + 0.5 * table.bin_width * edges
            true = np.mean(law[0] + law[1] * np.maximum(within, 0.1) ** law[2], axis=1)
            known = column.measured
            spread = np.sqrt(2.0 / column.count[known]) * column.difference_variance[known]
            deviations = np.abs(column.variance[known] - true[known]) / spread
            self.assertLess(deviations.max(), sigmas)
            self.assertLess(np.sqrt(np.mean(deviations**2)), 1.5)

    def test_known_variance_is_recovered(self):
        table = covariance_table(pairs(), 2.0, 30.0, 30)
        self.assertTrue(np.all(table.range.measured[1:]))
        self.assert_recovers(table)

    def test_outliers_do_not_matter(self):
        """One in twenty pairs is of two objects."""
        generator = random()
        mixed = [
            pair._replace(range_difference=float(generator.uniform(-5.0, 5.0)),
                          bearing_difference=float(generator.uniform(-0.2, 0.2)))
            if i % 20 == 0 else pair
            for i, pair in enumerate(pairs())
        ]  # fmt: skip
        table = covariance_table(mixed, 2.0, 30.0, 30)
        plain = covariance_table(pairs(), 2.0, 30.0, 30)
        for column, other in ((table.range, plain.range), (table.bearing, plain.bearing)):
            known = column.measured
            ratios = column.variance[known] / other.variance[known]
            self.assertLess(np.abs(np.log(ratios)).max(), math.log(1.5))

    def test_lidar_covariance_is_taken_out(self):
        self.assert_recovers(covariance_table(pairs(lidar=(0.2, 0.01)), 2.0, 30.0, 30))

    def test_variance_stays_above_zero(self):
        """A lidar that says that it is worse than all differences."""
        doubtful = [pair._replace(known_range_variance=100.0) for pair in pairs()]
        column = covariance_table(doubtful, 2.0, 30.0, 30).range
        self.assertFalse(np.any(column.measured))
        self.assertTrue(np.all(column.variance > 0.0))
        known = column.enough
        self.assertTrue(np.all(column.variance[known] < column.difference_variance[known]))

    def test_lidar_that_hides_all_but_one_bin(self):
        """The others' variance is that of the law, and not nothing."""
        sure = [
            pair._replace(known_range_variance=1.5 * (RANGE_LAW[0] + RANGE_LAW[1] * pair.range**4))
            for pair in pairs() if not 14.0 <= pair.range < 16.0
        ] + [pair for pair in pairs() if 14.0 <= pair.range < 16.0]  # fmt: skip
        column = covariance_table(sure, 2.0, 20.0, 30).range
        self.assertEqual(np.flatnonzero(column.measured).tolist(), [7])
        self.assertTrue(np.all(column.variance >= 0.09 * column.variance[7]))

    def test_bin_that_the_lidar_hides_is_of_the_law(self):
        """A lidar that is worse than the camera up to 12 m, and tells so."""
        noise = random().standard_normal(20000)
        hidden = [
            pair._replace(range_difference=pair.range_difference + float(offset),
                          known_range_variance=1.0)
            if pair.range < 12.0 else pair
            for pair, offset in zip(pairs(20000), noise)
        ]  # fmt: skip
        column = covariance_table(hidden, 2.0, 30.0, 30).range
        self.assertFalse(np.any(column.measured[:6]))
        self.assertTrue(np.all(column.measured[6:]))
        centers = (np.arange(15) + 0.5) * 2.0
        true = RANGE_LAW[0] + RANGE_LAW[1] * centers**4
        np.testing.assert_allclose(column.variance[:6], true[:6], rtol=0.5)

    def test_gaps_are_filled_by_the_law(self):
        """Nothing from 10 m to 16 m, and beyond 24 m."""
        chosen = [pair for pair in pairs() if not 10.0 <= pair.range < 16.0 and pair.range < 24.0]
        column = covariance_table(chosen, 2.0, 36.0, 30).range
        filled = ~column.measured
        self.assertEqual(np.flatnonzero(filled).tolist(), [0, 5, 6, 7, *range(12, 18)])
        centers = (np.arange(18) + 0.5) * 2.0
        true = RANGE_LAW[0] + RANGE_LAW[1] * centers**4
        np.testing.assert_allclose(column.variance[filled], true[filled], rtol=0.25)

    def test_bias_is_reported_and_added_only_on_demand(self):
        biased = pairs(bias=0.5)
        column = covariance_table(biased, 2.0, 30.0, 30).range
        np.testing.assert_allclose(column.bias[1:5], 0.5, atol=0.05)
        self.assert_recovers(covariance_table(biased, 2.0, 30.0, 30))
        added = covariance_table(biased, 2.0, 30.0, 30, with_bias=True).range
        np.testing.assert_allclose((added.variance - column.variance)[1:],
                                   column.bias[1:] ** 2, rtol=1e-6)  # fmt: skip

    def test_few_pairs(self):
        with self.assertRaisesRegex(
            InputError, "20 pairs with range; 0 bins .* expected two bins: bags with more traffic"
        ):
            covariance_table(pairs(20), 2.0, 30.0, 30)
        with self.assertRaisesRegex(InputError, "0 pairs with range"):
            covariance_table([], 2.0, 30.0, 30)

    def test_wider_bins_are_advised_where_they_would_do(self):
        few = pairs(100)
        with self.assertRaisesRegex(InputError, "or --bin-width ([0-9]+)$") as context:
            covariance_table(few, 2.0, 30.0, 30)
        width = float(str(context.exception).rsplit(" ", 1)[1])
        self.assertEqual(covariance_table(few, width, 30.0, 30).bin_width, width)

    def test_normal_spread(self):
        spread = robust_spread(random().normal(1.0, 2.0, 20000))
        self.assertAlmostEqual(spread.variance, 4.0, delta=0.1)
        self.assertAlmostEqual(spread.bias, 1.0, delta=0.05)

    def test_law_is_never_below_zero(self):
        """Variances that fall with range: no r^4 in them."""
        ranges = np.array([5.0, 10.0, 20.0])
        nothing = np.zeros(3)
        law = fitted_law(ranges, [0.3, 0.2, 0.1], nothing, [50, 50, 50], 4)
        self.assertEqual(law.factor, 0.0)
        self.assertTrue(0.1 < law.constant < 0.3)
        # That grow faster: no constant.
        law = fitted_law(ranges, 1e-6 * ranges**5, nothing, [50, 50, 50], 4)
        self.assertEqual(law.constant, 0.0)


class Tool(unittest.TestCase):
    """A vehicle that drives at 10 m/s, and oncoming cars, seen by a scanner and a camera.

    The camera stands 1.5 m ahead, and looks 30 ms after the scan; the scan takes 20 ms to the cars.
    """

    CAMERA = np.array([1.5, 0.0])  # m
    SPEED, CAR_SPEED = 10.0, -8.0  # m/s
    ROUND = 0.2  # s: two scans; then the cars stand where they stood ahead of the vehicle

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.bag, self.out = self.root / "run.bag", self.root / "table.yaml"

    def write(self, *topics, rounds=50, range_sigma=0.3, across_sigma=0.05):
        """A bag with lists on the topics: each round two scans, and an image between them."""
        noise = random().standard_normal((rounds, 10, 2)) * [range_sigma, across_sigma]
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
        """Of all cars, half a meter off; way: of the vehicle, m."""
        tracks = []
        for i in range(10):
            middle = Point(distance + self.ahead(stamp, i) + 2.5, 3.0 * i - 13.5, 0.0)
            position = Pose(middle, Quaternion(0.0, 0.0, 0.0, 1.0))
            tracks.append(Track(pose=position, size=Vector3(4.0, 1.8, 0.0), moving=True,
                                velocity=Vector3(self.CAR_SPEED, 0.0, 0.0)))  # fmt: skip
        return TrackArray(header=bag_messages.header(stamp, "map"), tracks=tracks)

    def ahead(self, stamp, number, delay=0.0):
        """How far a car's near side is ahead of the vehicle at a stamp, as it is `delay` later."""
        since = (stamp - START) * 1e-9 % self.ROUND
        return 6.5 + 2.0 * number + self.CAR_SPEED * (since + delay) - self.SPEED * since

    def calibrate(self, *words, code=0, runs=None):
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            given = runs or [str(self.bag)]
            arguments = [*given, "--out", str(self.out), "--range", "26", *words]
            self.assertEqual(main(arguments), code, errors.getvalue())
        return out.getvalue(), errors.getvalue()

    def table(self, source="stereo"):
        read = yaml.safe_load(self.out.read_text())
        return read["object_fusion"]["sources"][source]["covariance"]

    def test_motion_of_vehicle_and_cars_is_taken_out(self):
        """Without the vehicle's the camera would be 0.3 m off, without the cars' 0.1 m."""
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

    def test_two_bags_are_one(self):
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
