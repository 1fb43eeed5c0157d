#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate risk: scores of drives that are worked out by hand, and its reading of bags."""

import contextlib
import io
import math
import re
import unittest

import rosbag
from datmo_tools.evaluate.main import main
from datmo_tools.evaluate.risk_scores import (
    HORIZONS,
    RiskDrive,
    RiskFrame,
    any_contact,
    brier_score,
    calibration_error,
    false_warnings,
    is_warned_in_time,
    lead_of,
    lead_share,
    outcomes,
    reliability,
    score,
    ttc_errors,
)
from datmo_tools.stamps import to_ros_time
from std_msgs.msg import Header

from datmo_fusion.msg import Risk, RiskArray, TrueContact, TrueObject, TrueObjectArray
from evaluate_case import EvaluateCase

NONE, WARNING = RiskArray.LEVEL_NONE, RiskArray.LEVEL_WARNING
START = 1000  # s


def frame(time, level=NONE, probability=0.0, ttc=None):
    return RiskFrame(time, level, (probability,) * 4, ttc)


def drive(frames, end, contact=None, seen=None):
    return RiskDrive("drive", frames, end, contact, seen)


class Scores(unittest.TestCase):
    def test_several_objects_are_independent(self):
        self.assertAlmostEqual(any_contact([0.5, 0.5]), 0.75)
        self.assertEqual(any_contact([]), 0.0)

    def test_errors_of_time_to_contact_are_those_of_the_last_seconds(self):
        frames = [frame(0.0, ttc=9.0), frame(2.0, ttc=2.2), frame(3.0, ttc=0.9), frame(3.5)]
        errors = ttc_errors([drive(frames, 4.0, contact=4.0)])
        self.assertEqual([round(error, 6) for error in errors], [0.2, -0.1])

    def test_the_lead_is_that_of_the_warning_that_lasts(self):
        frames = [frame(0.0, WARNING), frame(1.0), frame(2.0, WARNING), frame(3.0, WARNING)]
        struck = drive(frames, 4.0, contact=4.0, seen=0.0)
        self.assertEqual(lead_of(struck), 2.0)
        self.assertTrue(is_warned_in_time(struck))
        self.assertEqual(false_warnings([struck]), 1, "that which ended before the contact")
        silent = drive([frame(0.0, WARNING), frame(1.0)], 4.0, contact=4.0, seen=0.0)
        self.assertIsNone(lead_of(silent))
        self.assertFalse(is_warned_in_time(silent))

    def test_late_warnings_of_briefly_visible_objects_are_allowed(self):
        frames = [frame(2.9), frame(3.0, WARNING)]
        self.assertFalse(is_warned_in_time(drive(frames, 4.0, contact=4.0, seen=0.0)))
        self.assertTrue(is_warned_in_time(drive(frames, 4.0, contact=4.0, seen=2.8)))

    def test_leads_are_compared_with_the_attainable_ones(self):
        half = drive([frame(2.0), frame(3.2, WARNING)], 4.0, contact=4.0, seen=2.4)
        silent = drive([frame(0.0)], 4.0, contact=4.0, seen=0.0)
        early = drive([frame(0.5, WARNING)], 4.0, contact=4.0, seen=0.0)
        self.assertAlmostEqual(lead_share([half, silent, early]), (0.5 + 0.0 + 1.0) / 3.0)
        self.assertIsNone(lead_share([drive([frame(0.0)], 4.0, contact=4.0)]))
        result = score([half, silent, early])
        self.assertEqual(result["long_seen"], {"contacts": 2, "in_time": 1})
        self.assertEqual(result["briefly_seen"], {"contacts": 1, "in_time": 0})

    def test_a_warning_without_contact_is_false(self):
        frames = [frame(0.0, WARNING), frame(1.0), frame(2.0, WARNING)]
        self.assertEqual(false_warnings([drive(frames, 3.0)]), 2)

    def test_outcomes_end_where_the_drive_does(self):
        near_miss = drive([frame(0.0, probability=0.3), frame(2.5, probability=0.6)], 3.0)
        self.assertEqual(outcomes([near_miss], 1.0).tolist(), [[0.3, 0.0]])
        struck = drive([frame(0.0, probability=0.3), frame(2.5, probability=0.6)], 3.0, contact=3.0)
        self.assertEqual(outcomes([struck], 1.0).tolist(), [[0.3, 0.0], [0.6, 1.0]])

    def test_brier_score_and_calibration(self):
        pairs = outcomes(
            [drive([frame(0.0, probability=0.8)], 1.0, contact=0.5),
             drive([frame(0.0, probability=0.8)], 1.0)], 1.0)  # fmt: skip
        self.assertAlmostEqual(brier_score(pairs), (0.04 + 0.64) / 2)
        self.assertEqual(reliability(pairs), [(0.8, 0.5, 2)])
        self.assertAlmostEqual(calibration_error(pairs), 0.3)

    def test_false_warnings_an_hour(self):
        result = score([drive([frame(0.0, WARNING)], 1800.0)])
        self.assertEqual(result["false_per_hour"], 2.0)
        self.assertEqual(result["near_misses_warned"], 1)
        self.assertIsNone(result["ttc_median_s"])


class Tool(EvaluateCase):
    def write(self, name, contact=None):
        """A drive of 3 s in which a warning of something ahead is given in the last two."""
        folder = self.folder / "runs"
        folder.mkdir(exist_ok=True)
        with rosbag.Bag(str(folder / f"{name}.bag"), "w") as bag:
            for step in range(30):
                stamp = to_ros_time(int((START + 0.1 * step) * 1e9))
                header = Header(stamp=stamp, frame_id="map")
                ahead = TrueObject(id=3, lidar_beams=5)
                bag.write("/ground_truth/objects", TrueObjectArray(header, [ahead]), stamp)
                risk = Risk(id=1, contact_probability=[0.0, 0.2, 0.6, 0.9])
                risk.median_ttc = 3.0 - 0.1 * step
                level = WARNING if step >= 10 else NONE
                bag.write("/risks", RiskArray(header=header, level=level, cause=1, risks=[risk]), stamp)
            if contact is not None:
                stamp = to_ros_time(int((START + contact) * 1e9))
                header = Header(stamp=stamp, frame_id="map")
                bag.write("/ground_truth/contact", TrueContact(header, 3, "Car", 1, 8.0), stamp)
        return folder

    def test_bags_are_scored(self):
        self.write("hit", contact=3.0)
        folder = self.write("miss")
        text, _, result = self.evaluate("risk", f"ours={folder}")
        self.assertRegex(text, r"contacts +1")
        self.assertRegex(text, r"in view for less, warned in time +1 of 1")
        self.assertRegex(text, r"near misses warned of +1")
        self.assertRegex(text, r"lead, median \[s\] +2.00")
        self.assertEqual(result["ours"]["drives"], 2)

    def test_the_page_has_a_reliability_diagram_with_each_method(self):
        folder = self.write("hit", contact=3.0)
        self.evaluate("risk", f"ours={folder}", f"others={folder}")
        page = (self.folder / "risk.html").read_text(encoding="utf-8")
        diagram = re.search(r"<svg.*?</svg>", page, re.DOTALL).group()
        for text in ("calibrated", "ours", "others", *(f"contact within {time:.0f} s" for time in HORIZONS)):
            self.assertIn(f">{text}</text>", diagram)

    def test_a_folder_without_bags_is_reported(self):
        _, errors, _ = self.evaluate("risk", f"ours={self.folder}", code=1)
        self.assertIn("no bag in it", errors)

    def test_a_method_needs_a_name(self):
        said = io.StringIO()
        with contextlib.redirect_stderr(said), self.assertRaises(SystemExit):
            main(["risk", str(self.folder)])
        self.assertIn(f"'{self.folder}', expected NAME=FOLDER", said.getvalue())

    def add(self, topic, message):
        """Adds a message at the start of a drive."""
        folder = self.write("hit")
        message.header.stamp = to_ros_time(START * 10**9)
        with rosbag.Bag(str(folder / "hit.bag"), "a") as bag:
            bag.write(topic, message, message.header.stamp)
        return f"ours={folder}"

    def test_two_messages_of_one_stamp(self):
        """They differ only in that one has no time to contact."""
        risk = Risk(id=1, contact_probability=[0.0, 0.2, 0.6, 0.9], median_ttc=math.inf)
        self.evaluate("risk", self.add("/risks", RiskArray(level=NONE, risks=[risk])))

    def test_a_contact_of_another_type_is_reported(self):
        _, errors, _ = self.evaluate("risk", self.add("/ground_truth/contact", RiskArray()), code=1)
        self.assertIn("/ground_truth/contact is datmo_fusion/RiskArray, expected datmo_fusion/TrueContact", errors)


if __name__ == "__main__":
    unittest.main()
