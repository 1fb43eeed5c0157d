#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate objects on lists and truths that are worked out by hand."""

import contextlib
import io
import math
import unittest

import numpy as np
import yaml
from datmo_tools import bag_messages, transforms
from datmo_tools.bag_file import whole_bag
from datmo_tools.evaluate.main import main
from datmo_tools.evaluate.object_lists import Seen
from datmo_tools.evaluate.object_scores import ListWithTruth, TrueState, score_lists
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3
from nav_msgs.msg import OccupancyGrid

from datmo_fusion.msg import Object, ObjectArray, TrueObject, TrueObjectArray
from evaluate_case import EvaluateCase
from object_samples import object_at
from old_objects import old_types

START = 1000 * 10**9
VEHICLE, PEDESTRIAN = Object.CLASS_VEHICLE, Object.CLASS_PEDESTRIAN
CAR = np.array([4.0, 2.0])


def seen(x, y, yaw=0.0, size=CAR, sides=(0.0, 0.0, 0.0, 0.0), delay=0.0):
    """With a variance of 0.04 m^2 along x and of 0.01 m^2 along y."""
    return Seen(np.array([x, y, yaw]), np.asarray(size), np.diag([0.04, 0.01]), np.array(sides),
                VEHICLE, delay)  # fmt: skip


def true(x, y, yaw=0.0, velocity=(0.0, 0.0)):
    return TrueState(np.array([x, y, yaw]), CAR, np.array(velocity), VEHICLE, True, True)


class Lists(unittest.TestCase):
    def assert_near(self, expected, *objects, truths=(true(20.0, 0.0),)):
        score = score_lists([ListWithTruth(list(objects), list(truths))])[0]
        self.assertEqual(score.near.tolist(), expected)
        return [(i, j) for i, j, _ in score.matches]

    def errors(self, item, truth):
        return score_lists([ListWithTruth([item], [truth])])[0].matches[0][2]

    def test_near_is_longer_along_the_line_of_sight(self):
        """Near sides at 18 m: 2.2 m along it for an object that appears at 16 m, 1 m across."""
        self.assertEqual(self.assert_near([True], seen(18.0, 0.0)), [(0, 0)])
        self.assert_near([False], seen(17.5, 0.0))
        self.assert_near([True], seen(20.0, 1.7))
        self.assert_near([False], seen(20.0, 2.4))
        self.assert_near([True], seen(6.0, 0.0), truths=[true(6.9, 0.0)])
        self.assert_near([False], seen(6.0, 0.0), truths=[true(7.1, 0.0)])

    def test_within_a_true_box_is_near(self):
        self.assert_near([True], seen(23.0, 0.0))

    def test_one_object_finds_one_true_one(self):
        """The nearer pair first; the other object is a duplicate."""
        objects = seen(19.0, 0.5), seen(20.0, 0.0)
        self.assertEqual(self.assert_near([True, True], *objects), [(1, 0)])
        cars = true(20.0, 0.0), true(22.0, 0.0)
        self.assertEqual(self.assert_near([True], seen(20.0, 0.0), truths=cars), [(0, 0)])

    def test_moving_objects_are_compared_at_the_stamp(self):
        """50 ms late, a car at 20 m/s is 1 m farther ahead."""
        errors = self.errors(seen(21.0, 0.0, delay=0.05), true(20.0, 0.0, velocity=(20.0, 0.0)))
        self.assertAlmostEqual(errors.along, 0.0)

    def test_errors_along_and_across_the_line_of_sight(self):
        errors = self.errors(seen(0.1, 30.4, math.pi / 2), true(0.0, 30.0, math.pi / 2))
        self.assertAlmostEqual(errors.along, 0.4, places=3)
        self.assertAlmostEqual(errors.across, -0.1, delta=0.01)
        self.assertAlmostEqual(errors.nees, 0.1**2 / 0.04 + 0.4**2 / 0.01, delta=0.1)

    def test_unseen_sides_have_no_error(self):
        sides = (math.inf, 0.0, math.inf, math.inf)
        errors = self.errors(seen(30.4, 0.0, sides=sides), true(30.0, 0.0))
        self.assertAlmostEqual(errors.along, 0.4)
        self.assertTrue(math.isnan(errors.across) and math.isnan(errors.nees))

    def test_no_objects_and_no_truth(self):
        self.assertEqual(self.assert_near([]), [])
        self.assertEqual(self.assert_near([False], seen(10.0, 0.0), truths=[]), [])


def true_object(number, x, y, classification=VEHICLE, speed=0.0, visible_to=("stereo",)):
    position = Pose(Point(x, y, 0.0), Quaternion(*transforms.quaternion_of_yaw(math.pi / 2)))
    return TrueObject(
        id=number, classification=classification, pose=position, size=Vector3(4.0, 2.0, 1.5),
        velocity=Vector3(0.0, speed, 0.0), moving=speed != 0.0, visible_to=list(visible_to),
    )  # fmt: skip


class Tool(EvaluateCase):
    """A vehicle at (100, 50) in the map that faces along its y axis."""

    TRUE = (
        true_object(1, 100.0, 58.0, speed=10.0),  # 8 m ahead
        true_object(2, 97.0, 65.0, PEDESTRIAN),  # 15 m ahead, 3 m to the left
        true_object(3, 110.0, 70.0, visible_to=("scanner",)),  # 20 m ahead, 10 m to the right
    )

    def setUp(self):
        super().setUp()
        self.bag, self.drive = self.folder / "run.bag", self.folder / "drive.bag"
        self.write_drive()

    def write_drive(self, objects=TRUE):
        with whole_bag(self.drive, "test") as bag:
            for stamp in (START, START + 10**9):
                pose = bag_messages.planar_odometry(
                    stamp, "map", "base_link", (100.0, 50.0, math.pi / 2), 0.0, 0.0)
                bag.write("/ground_truth/pose", stamp, pose)
                message = TrueObjectArray(header=bag_messages.header(stamp, "map"), objects=objects)
                bag.write("/ground_truth/objects", stamp, message)

    def write(self, topic, *objects, seconds=0.0):
        stamp = START + round(seconds * 1e9)
        with whole_bag(self.bag, "test") as bag:
            header = bag_messages.header(stamp, "base_link")
            bag.write(topic, stamp, ObjectArray(header=header, objects=objects))

    def score(self, *words, code=0):
        """Returns standard output and error, and the scores of the topics."""
        words = ("objects", self.bag, "--truth", self.drive, *words)
        out, errors, score = self.evaluate(*words, code=code)
        return out, errors, score and score["topics"]

    def test_counts(self):
        """The car found 0.2 m too far, 0.1 s after the truth; a wall, and a duplicate."""
        self.write("/objects/stereo", object_at(9.2, 0.0, variance=0.04), object_at(25.0, 0.0),
                   object_at(10.5, 0.0), seconds=0.1)  # fmt: skip
        out, _, figures = self.score()
        figures = figures["/objects/stereo"]
        self.assertEqual(figures["recall"]["vehicle"]["of"], [1, 0, 0, 0, 1])
        self.assertEqual(figures["recall"]["vehicle"]["share"], [1.0, None, None, None, 1.0])
        self.assertEqual(figures["recall"]["pedestrian"]["share"], [None, 0.0, None, None, 0.0])
        self.assertEqual(figures["recall"]["moving"]["of"][-1], 1)
        self.assertEqual(figures["recall"]["all"]["share"][-1], 0.5)
        self.assertEqual(figures["precision"]["vehicle"]["count"], [1, 1, 0, 0, 2])
        self.assertEqual(figures["precision"]["vehicle"]["of"], [1, 1, 1, 0, 3])
        self.assertEqual(figures["objects_per_list"], 3.0)
        self.assertEqual(figures["false_per_list"], 1.0)
        self.assertEqual(figures["doubles_per_list"], 1.0)
        errors = figures["errors"][-1]
        self.assertEqual(errors["along_count"], 1)
        self.assertAlmostEqual(errors["along_mean_m"], 0.2, places=6)
        self.assertAlmostEqual(errors["median_nees"], 1.0, delta=0.01)
        self.assertEqual(errors["in_gate"], 1.0)
        self.assertIn("100.0 of 1", out)

    def test_class(self):
        self.write("/objects/stereo", object_at(8.0, 0.0), object_at(15.0, 3.0, size=(0.6, 0.6)))
        figures = self.score()[2]["/objects/stereo"]
        self.assertEqual(figures["class_right"]["vehicle"]["share"], 1.0)
        self.assertEqual(figures["class_right"]["pedestrian"], {"count": 0, "of": 1, "share": 0.0})
        self.assertEqual(figures["said"]["pedestrian"]["vehicle"], 1)

    def test_calibration_of_classes(self):
        """Of three reports that of the car is right; the pedestrian and a wall are no vehicles."""
        self.write("/objects/mono", object_at(8.0, 0.0), object_at(15.0, 3.0, size=(0.6, 0.6)), object_at(30.0, 0.0))
        table, out = self.folder / "table.yaml", io.StringIO()
        with contextlib.redirect_stdout(out):
            code = main(["calibrate_classes", str(self.bag), "--truth", str(self.drive), "--detector", "dnn",
                         "--out", str(table)])  # fmt: skip
        self.assertEqual(code, 0)
        self.assertIn("3 reports, 1 of them right", out.getvalue())
        reliability = yaml.safe_load(table.read_text())["mono_classifier"]["dnn"]["reliability"]
        self.assertEqual((reliability["scores"], reliability["right"]), ([0.0], [0.4]))
        of_vehicles = reliability["mistaken"][10:]
        self.assertEqual(of_vehicles, [0.333, 0.333, 0.167, 0.0, 0.167])

    def test_sensor_that_must_see(self):
        """The topic's sensor, or the named one; what another sensor sees is not false."""
        for topic, words, asked in (("/objects", (), 1), ("/objects/fused", (), 3),
                                    ("/objects/stereo", ("--visible-to", "none"), 3),
                                    ("/mine", ("--topic", "/mine"), 3)):  # fmt: skip
            self.write(topic, object_at(20.0, -10.0))
            figures = self.score(*words)[2][topic]
            self.assertEqual(figures["recall"]["all"]["of"][-1], asked)
            self.assertEqual(figures["recall"]["all"]["count"][-1], 1)
            self.assertEqual(figures["false_per_list"], 0.0)

    def test_stationary_objects_are_not_required(self):
        self.write("/objects/stereo", object_at(8.0, 0.0), object_at(15.0, 3.0, size=(0.6, 0.6)))
        figures = self.score("--moving-only")[2]["/objects/stereo"]
        self.assertEqual(figures["recall"]["all"]["of"][-1], 1)
        self.assertEqual(figures["errors"][-1]["along_count"], 1)
        self.assertEqual(figures["false_per_list"], 0.0)

    def test_region(self):
        positions = (8.0, 0.0), (0.0, 12.0), (16.0, 0.0)
        self.write("/objects/stereo", *(object_at(*position) for position in positions))
        words = ("--half-angle", "0.1", "--range", "15.1")
        figures = self.score(*words)[2]["/objects/stereo"]
        self.assertEqual(figures["bands_m"], [[0.0, 10.0], [10.0, 15.1]])
        self.assertEqual(figures["recall"]["all"]["of"][-1], 1)
        self.assertEqual(figures["objects_per_list"], 1.0)

    def test_object_that_is_not_finite_is_left_out(self):
        positions = (8.0, 0.0), (math.nan, 0.0)
        self.write("/objects/stereo", *(object_at(*position) for position in positions))
        figures = self.score()[2]["/objects/stereo"]
        self.assertEqual(figures["objects_per_list"], 1.0)
        self.assertEqual(figures["recall"]["vehicle"]["count"][-1], 1)

    def test_bad_input(self):
        self.write("/other", object_at(8.0, 0.0))
        self.assertIn("nothing on /objects, /objects/stereo, /objects/mono, /objects/fused", self.score(code=1)[1])
        self.assertIn("nothing on /mine", self.score("--topic", "/mine", code=1)[1])
        self.write("/objects/stereo", object_at(8.0, 0.0), seconds=5.0)
        self.assertIn("no list has a stamp near", self.score(code=1)[1])
        self.write("/objects/stereo", object_at(8.0, 0.0))
        self.assertIn("--range is 0", self.score("--range", "0", code=1)[1])
        self.assertIn("--half-angle is 4", self.score("--half-angle", "4", code=1)[1])
        said = self.score("--visible-to", "radar", code=1)[1]
        self.assertIn("no true object is visible to radar, only to scanner, stereo", said)
        with whole_bag(self.bag, "test") as bag:
            message = OccupancyGrid(header=bag_messages.header(START, "base_link"))
            bag.write("/objects", START, message)
        said = self.score(code=1)[1]
        self.assertIn("/objects is nav_msgs/OccupancyGrid, expected datmo_fusion/ObjectArray", said)
        with whole_bag(self.bag, "test") as bag:
            bag.write("/objects", START, old_types(ObjectArray)[ObjectArray._type]())
        self.assertIn("/objects is another version of datmo_fusion/ObjectArray", self.score(code=1)[1])
        self.write("/objects/stereo", object_at(8.0, 0.0))
        with whole_bag(self.drive, "test") as bag:
            bag.write("/other", START, message)
        self.assertIn("nothing on /ground_truth/objects", self.score(code=1)[1])


if __name__ == "__main__":
    unittest.main()
