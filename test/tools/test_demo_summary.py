#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The figures of demo_summary on drives that are worked out by hand."""

import importlib.util
import unittest
from importlib.machinery import SourceFileLoader
from pathlib import Path

LOADER = SourceFileLoader(
    "demo_summary", str(Path(__file__).resolve().parents[2] / "tools/launch/demo_summary"))
demo_summary = importlib.util.module_from_spec(
    importlib.util.spec_from_loader("demo_summary", LOADER))
LOADER.exec_module(demo_summary)


class Quantile(unittest.TestCase):
    def test_nearest_rank(self):
        values = [5.0, 1.0, 4.0, 2.0, 3.0]
        self.assertEqual(demo_summary.quantile(values, 0.5), 3.0)
        self.assertEqual(demo_summary.quantile(values, 0.99), 5.0)
        self.assertEqual(demo_summary.quantile(values, 0.0), 1.0)

    def test_no_values(self):
        self.assertEqual(demo_summary.quantile([], 0.5), 0.0)


class Pictures(unittest.TestCase):
    @staticmethod
    def of(*arguments):
        return demo_summary.Pictures(demo_summary.parse_arguments(["--picture", "p.png", *arguments]))

    def test_a_picture_is_taken_once_when_it_is_due(self):
        pictures = self.of("--picture-at", "10")
        self.assertEqual([pictures.due(at) for at in (9.9, 10.1, 10.2)], [None, "p.png", None])
        self.assertIsNone(pictures.at_end())

    def test_of_a_shorter_drive_it_is_taken_at_the_end(self):
        pictures = self.of("--picture-at", "10", "--frames", "f", "--frames-to", "10")
        self.assertEqual(pictures.due(0.6), "f/001.png")
        self.assertEqual(pictures.at_end(), "p.png")

    def test_none_is_asked_for(self):
        self.assertIsNone(demo_summary.Pictures(demo_summary.parse_arguments([])).at_end())


class DriveSummary(unittest.TestCase):
    def setUp(self):
        self.summary = demo_summary.DriveSummary()

    def test_distance_is_path_length(self):
        for x, y in [(0.0, 0.0), (3.0, 4.0), (3.0, 10.0)]:
            self.summary.add_pose(x, y)
        self.assertEqual(self.summary.scans, 3)
        self.assertAlmostEqual(self.summary.distance, 11.0)

    def test_each_track_counts_once(self):
        self.summary.add_tracks([1, 2])
        self.summary.add_tracks([2, 5])
        self.assertIn("tracks confirmed                         3", self.summary.table())

    def test_time_per_scan_is_that_of_all_its_stages(self):
        self.summary.add_timing(stamp=100, seconds=0.001)
        self.summary.add_timing(stamp=100, seconds=0.002)
        self.summary.add_timing(stamp=200, seconds=0.005)
        table = self.summary.table()
        self.assertIn("median               3.0 ms", table)
        self.assertIn("99th percentile      5.0 ms", table)

    def test_empty_drive_has_a_table(self):
        self.assertIn("scans processed                          0", self.summary.table())


if __name__ == "__main__":
    unittest.main()
