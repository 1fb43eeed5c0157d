#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Confusion and calibration of classes on reports worked out by hand."""

import unittest

import numpy as np
from datmo_tools.evaluate.class_tally import (
    NOTHING,
    Report,
    calibration,
    class_sections,
    confusion,
    reports_of,
)
from datmo_tools.evaluate.object_lists import Seen
from datmo_tools.evaluate.object_scores import TrueState, score_list
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
    def test_reports_are_what_is_said_of_what_is_there(self):
        objects = [seen(10.0, Object.CLASS_VEHICLE), seen(20.0, Object.CLASS_PEDESTRIAN),
                   seen(30.0, Object.CLASS_VEHICLE), seen(40.0, Object.CLASS_UNKNOWN),
                   seen(90.0, Object.CLASS_VEHICLE)]  # fmt: skip
        truths = [true(10.0, Object.CLASS_VEHICLE), true(20.0, Object.CLASS_CYCLIST)]
        found = reports_of(objects, truths, score_list(objects, truths), Region(50.0))
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


if __name__ == "__main__":
    unittest.main()
