#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of runs without and with road borders, with made-up scores."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

from datmo_tools.evaluate.border_comparison import comparison, comparison_table
from datmo_tools.evaluate.border_tally import BANDS
from datmo_tools.evaluate.main import main
from datmo_tools.experiments.border_runs import BorderRuns, border_runs_table


def report(false_moving, in_a_scan, tracked, **counts):
    """A report of score_run; tracked: dictionary id -> frames in which the object is tracked."""
    thesis = {
        "false_moving_objects_episodes": false_moving, "false_moving_objects_frames": in_a_scan,
        "tracks": 12, "false_tracks": 4, "moving_objects": len(tracked), "missed_objects": 0,
        "intersections": 2, "intersections_found": None, "intersections_false": None,
    }  # fmt: skip
    objects = [
        {"id": number, "label": "Pedestrian", "required_frames": 50, "tracked_frames": frames}
        for number, frames in tracked.items()
    ]
    return {"format": 1, "thesis": dict(thesis, **counts), "objects": objects}


WITHOUT = report(100, 2.5, {1: 30, 2: 1, 3: 0, 4: 0})
WITH = report(20, 0.5, {1: 28, 2: 0, 3: 3, 4: 0},
              false_tracks=1, intersections_found=2, intersections_false=0)  # fmt: skip


class Comparison(unittest.TestCase):
    def setUp(self):
        self.result = comparison(WITHOUT, WITH)

    def test_objects_that_are_lost_and_gained(self):
        self.assertEqual((self.result["lost"], self.result["gained"]), ([2], [3]))
        self.assertEqual(self.result["tracked_frames"], {"without": 31, "with": 31})

    def test_reductions(self):
        self.assertEqual(
            {key: round(value, 9) for key, value in self.result["reduction"].items()},
            {"false_moving_objects_episodes": 0.8, "false_moving_objects_frames": 0.8,
             "false_tracks": 0.75},
        )  # fmt: skip
        nothing = comparison(report(0, None, {}), WITH)
        self.assertEqual(nothing["reduction"]["false_moving_objects_episodes"], None)
        self.assertEqual(nothing["reduction"]["false_moving_objects_frames"], None)

    def test_table(self):
        rows = [line.split() for line in comparison_table(self.result).splitlines()]
        self.assertIn(["false", "moving", "objects", "100", "20", "80.0"], rows)
        self.assertIn(["found", "-", "2", "-"], rows)
        self.assertIn(["Pedestrian", "2", "50", "1", "0"], rows)
        self.assertIn(["lost:", "Pedestrian", "2"], rows)

    def test_nothing_lost(self):
        self.assertIn("lost: none", comparison_table(comparison(WITHOUT, WITHOUT)))


class DataSets(unittest.TestCase):
    def test_both_runs_are_listed_one_below_the_other(self):
        stage = {"grid_slam": {"runs": 10, "mean_s": 0.001}}
        item = {"found_share": 0.9, "rms_m": 0.25, "in_gate_95": 0.96}
        nothing = dict.fromkeys(item)
        borders = {
            "bands_m": [list(band) for band in BANDS],
            "borders": {"straight": [item] * 7, "curve": [nothing] * 7, "all": [item] * 7},
            "false": {"false_share": 0.01},
        }
        runs = BorderRuns(WITHOUT, WITH, stage, stage, borders)
        rows = [line.split() for line in border_runs_table([runs, None]).splitlines()]
        self.assertIn(["1", "without", "100", "2.50", *"--", "12", "4", "0", "-", "31", "1.0"],
                      rows)  # fmt: skip
        self.assertIn(["1", "with", "20", "0.50", "80.0", "80.0", "12", "1", "0", "1", "31", "1.0"],
                      rows)  # fmt: skip
        self.assertIn(["2", "with", *10 * "-"], rows)
        self.assertIn(["1", "90.0", "-", "0.25", "-", "96.0", "1.0"], rows)
        self.assertIn(["2", *6 * "-"], rows)


class Tool(unittest.TestCase):
    """With a stand-in for score_run that returns the bag's content as the score."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.program = self.folder / "score_run"
        self.program.write_text('#!/bin/sh\nbag=$1; while [ "$1" != --out ]; do shift; done\n'
                                'cp "$bag" "$2"\n')  # fmt: skip
        self.program.chmod(0o755)
        for name, content in (("without", WITHOUT), ("with", WITH)):
            (self.folder / name).write_text(json.dumps(content))

    def test_scores_both_bags(self):
        out, file = io.StringIO(), self.folder / "out.json"
        with contextlib.redirect_stdout(out):
            code = main(["compare_borders", str(self.folder / "without"), str(self.folder / "with"),
                         "--json", str(file)], str(self.program))  # fmt: skip
        self.assertEqual(code, 0)
        self.assertEqual(json.loads(file.read_text())["lost"], [2])
        self.assertIn("lost: Pedestrian 2", out.getvalue())

    def test_failure_of_score_run_is_explained(self):
        with self.assertRaises(SystemExit) as ended:
            main(["compare_borders", str(self.folder / "without"), "/nowhere/with"], str(self.program))
        self.assertNotEqual(ended.exception.code, 0)


if __name__ == "__main__":
    unittest.main()
