#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Confusion and calibration of classes, and evaluate calibrate_classes, on reports worked out by hand."""

import unittest

import numpy as np
import yaml
from datmo_tools.errors import InputError
from datmo_tools.evaluate.box_crops import Box
from datmo_tools.evaluate.calibrate_classes import as_yaml, curve, mistaken, rising
from datmo_tools.evaluate.class_mistakes import worst
from datmo_tools.evaluate.class_tally import (
    NOTHING,
    Report,
    calibration,
    class_sections,
    confusion,
    reports_of,
)
from datmo_tools.evaluate.object_lists import Seen
from datmo_tools.evaluate.object_scores import ListWithTruth, TrueState, score_lists
from datmo_tools.evaluate.truth import Region
from datmo_tools.pose_path import PosePath

from datmo_fusion.msg import Object

CAR = np.array([4.0, 2.0])
STANDING = PosePath([0, 10], [(100.0, 0.0, 0.0)] * 2)


def seen(x, classification, probability=0.8):
    return Seen(np.array([x, 0.0, 0.0]), CAR, np.eye(2), np.zeros(4), classification, 0.0, probability)


def true(x, classification):
    return TrueState(np.array([x, 0.0, 0.0]), CAR, np.zeros(2), classification, False, True)


def reports(right, wrong, score, said="vehicle", instead=NOTHING):
    return [Report(said, score, said, 10.0)] * right + [Report(said, score, instead, 10.0)] * wrong


class Tally(unittest.TestCase):
    def test_reports_are_counted_by_true_class(self):
        objects = [seen(10.0, Object.CLASS_VEHICLE), seen(20.0, Object.CLASS_PEDESTRIAN),
                   seen(30.0, Object.CLASS_VEHICLE), seen(40.0, Object.CLASS_UNKNOWN),
                   seen(90.0, Object.CLASS_VEHICLE)]  # fmt: skip
        truths = [true(10.0, Object.CLASS_VEHICLE), true(20.0, Object.CLASS_CYCLIST)]
        judged = ListWithTruth(objects, truths, stamp=5)
        found = reports_of(judged, score_lists([judged])[0], Region(50.0), STANDING)
        self.assertEqual([(item.said, item.true) for item in found],
                         [("vehicle", "vehicle"), ("pedestrian", "cyclist"), ("vehicle", NOTHING)])
        self.assertEqual((found[1].stamp, found[1].box.pose.tolist()), (5, [120.0, 0.0, 0.0]))

    def test_confusion_is_by_range(self):
        near = reports(3, 1, 0.9, instead="cyclist")
        far = [item._replace(distance=30.0) for item in reports(0, 2, 0.9)]
        first, second = confusion(near + far, [0.0, 20.0, 40.0])
        self.assertEqual(first["vehicle"]["vehicle"], 3)
        self.assertEqual(first["cyclist"]["vehicle"], 1)
        self.assertEqual(second[NOTHING]["vehicle"], 2)
        self.assertEqual(second["vehicle"]["vehicle"], 0)

    def test_calibration_is_the_share_that_is_right(self):
        bins = calibration(reports(3, 1, 0.9) + reports(1, 3, 0.3))
        self.assertEqual([item["count"] for item in bins], [4, 4])
        np.testing.assert_allclose([item["said"] for item in bins], [0.3, 0.9])
        np.testing.assert_allclose([item["right"] for item in bins], [0.25, 0.75])

    def test_a_list_without_classes_has_no_sections(self):
        self.assertEqual(class_sections({"calibration": []}), [])


class Mistakes(unittest.TestCase):
    def report(self, said, true, probability, x=0.0, true_id=None):
        return Report(said, probability, true, 10.0, 0, Box(np.array([x, 0.0, 0.0]), (1.0, 1.0, 1.0), np.zeros(2)),
                      true_id=true_id)  # fmt: skip

    def test_wrong_classes_come_first_and_the_most_confident_of_each(self):
        found = worst([self.report("vehicle", NOTHING, 0.9), self.report("vehicle", "cyclist", 0.3, true_id=1),
                       self.report("vehicle", "cyclist", 0.5, true_id=2), self.report("cyclist", "cyclist", 0.9)], 9)
        self.assertEqual([item.probability for item in found], [0.5, 0.3, 0.9])

    def test_one_thing_is_one_mistake(self):
        """Of one object and class, or at one place."""
        found = worst([self.report("vehicle", "cyclist", 0.3, 0.0, 1), self.report("vehicle", "cyclist", 0.5, 9.0, 1),
                       self.report("pedestrian", "cyclist", 0.2, 0.0, 1), self.report("vehicle", NOTHING, 0.9, 0.0),
                       self.report("vehicle", NOTHING, 0.8, 1.5), self.report("vehicle", NOTHING, 0.7, 4.0)], 9)
        self.assertEqual([item.probability for item in found], [0.5, 0.2, 0.9, 0.7])

    def test_what_the_truth_does_not_know_is_no_mistake(self):
        self.assertEqual(worst([self.report("vehicle", "unknown", 0.9, true_id=1)], 9), [])


class Calibrate(unittest.TestCase):
    def test_decreasing_shares_are_pooled(self):
        np.testing.assert_allclose(rising([0.1, 0.5, 0.3, 0.9], [1, 1, 1, 1]), [0.1, 0.4, 0.4, 0.9])
        np.testing.assert_allclose(rising([0.6, 0.0], [1, 2]), [0.2, 0.2])

    def test_the_curve_goes_through_the_shares_of_bins(self):
        scores, shares = curve(reports(1, 3, 0.3) + reports(3, 1, 0.9), 4)
        np.testing.assert_allclose(scores, [0.3, 0.9])
        np.testing.assert_allclose(shares, [2 / 6, 4 / 6])

    def test_bins_of_one_score_are_one(self):
        """A network gives many a score that differs from the next one by less than is written."""
        for last in (0.5, 0.5004):
            scores, shares = curve(reports(30, 0, 0.5) + reports(2, 8, last), 10)
            self.assertEqual(scores, [0.5])
            np.testing.assert_allclose(shares, [33 / 42])

    def test_without_reports_there_is_no_curve(self):
        with self.assertRaises(InputError):
            curve([], 10)

    def test_mistakes_are_counted_by_true_class(self):
        table = np.reshape(mistaken(reports(5, 3, 0.5) + reports(0, 1, 0.5, instead="cyclist")), (3, 5))
        np.testing.assert_allclose(table[2], [0.5, 0.125, 0.25, 0.0, 0.125])
        self.assertEqual(table[0][1], 0.0)

    def test_the_section_is_that_of_the_detector(self):
        section = yaml.safe_load(as_yaml("dnn", reports(8, 2, 0.7), 5))
        reliability = section["mono_classifier"]["dnn"]["reliability"]
        self.assertEqual(set(reliability), {"scores", "right", "mistaken"})
        self.assertEqual(len(reliability["mistaken"]), 15)


if __name__ == "__main__":
    unittest.main()
