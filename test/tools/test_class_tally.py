#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Confusion and calibration of classes, and calibrate_classes, on reports worked out by hand."""

import unittest

import numpy as np
import yaml
from datmo_tools.errors import InputError
from datmo_tools.evaluate.calibrate_classes import as_yaml, curve, mistaken, rising
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

from datmo_fusion.msg import Object

CAR = np.array([4.0, 2.0])


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
        score = score_lists([ListWithTruth(objects, truths)])[0]
        found = reports_of(objects, truths, score, Region(50.0))
        self.assertEqual([(item.said, item.true) for item in found],
                         [("vehicle", "vehicle"), ("pedestrian", "cyclist"), ("vehicle", NOTHING)])

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


class Calibrate(unittest.TestCase):
    def test_decreasing_shares_are_pooled(self):
        np.testing.assert_allclose(rising([0.1, 0.5, 0.3, 0.9], [1, 1, 1, 1]), [0.1, 0.4, 0.4, 0.9])
        np.testing.assert_allclose(rising([0.6, 0.0], [1, 2]), [0.2, 0.2])

    def test_the_curve_goes_through_the_shares_of_bins(self):
        scores, shares = curve(reports(1, 3, 0.3) + reports(3, 1, 0.9), 4)
        np.testing.assert_allclose(scores, [0.3, 0.9])
        np.testing.assert_allclose(shares, [2 / 6, 4 / 6])

    def test_scores_increase_despite_ties(self):
        scores, shares = curve(reports(40, 0, 0.5), 10)
        self.assertEqual(scores, [0.5])
        self.assertEqual(len(shares), 1)

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
