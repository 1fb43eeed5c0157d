#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The thesis's tables beside ours: against the thesis's text, and runs with stand-in programs."""

import contextlib
import io
import json
import re
import tempfile
import unittest
from pathlib import Path

from datmo_tools.experiments.data_sets import main
from datmo_tools.experiments.fusion_table import FusionRuns, fusion_table
from datmo_tools.evaluate.thesis_tables import PUBLISHED, thesis_tables

ROOT = Path(__file__).resolve().parents[2]
THESIS = ROOT.parent / "shared" / "thesis" / "baig_2012_multisensor_fusion.txt"

COUNTS = {
    "moving_objects": 30, "missed_objects": 6, "tracks": 42, "false_tracks": 15,
    "confirmed_tracks": 0, "confirmed_true_tracks": 0, "false_moving_objects_episodes": 423,
    "false_moving_objects_frames": 1.26, "intersections": 2, "intersections_found": None,
    "intersections_false": None,
}


def rows(text, title):
    """Returns the rows of the table with this title, without its headings, as lists of words."""
    lines = text[text.index(title):].splitlines()
    return [line.split() for line in lines[3:6]]


class Tables(unittest.TestCase):
    def test_ours_are_listed_beside_the_thesis(self):
        text = thesis_tables([{"thesis": COUNTS}, None, {"thesis": COUNTS}])
        self.assertEqual(rows(text, "Table 3.1")[0], ["1", "64", "30", "30"])
        self.assertEqual(rows(text, "Table 3.2")[0], ["1", "10", "7", "6"])
        self.assertEqual(rows(text, "Table 3.3")[0], ["1", "108", "24", "18", "42", "15", "-", "-"])
        self.assertEqual(rows(text, "Table 3.4")[2], ["3", "150", "95", "423", "1.3", "-", "-"])
        self.assertEqual(rows(text, "Table 3.5")[2], ["3", "4", "4", "4", "2", "-", "-"])

    def test_runs_with_borders_have_columns_of_their_own(self):
        bordered = dict(COUNTS, false_moving_objects_episodes=60, false_moving_objects_frames=0.21,
                        intersections_found=2, intersections_false=1)  # fmt: skip
        text = thesis_tables([{"thesis": COUNTS}] * 3, [{"thesis": bordered}, None, None])
        self.assertEqual(rows(text, "Table 3.4")[0], ["1", "70", "45", "423", "1.3", "60", "0.2"])
        self.assertEqual(rows(text, "Table 3.5")[0], ["1", "2", "2", "1", "2", "2", "1"])
        self.assertEqual(rows(text, "Table 3.4")[1], ["2", "103", "80", "423", "1.3", "-", "-"])

    def test_run_without_score_has_no_counts(self):
        text = thesis_tables([None, None, None])
        self.assertEqual(rows(text, "Table 3.2")[1], ["2", "12", "8", "-"])

    def test_tracks_of_two_sensors(self):
        counts = dict(COUNTS, confirmed_tracks=20, confirmed_true_tracks=19)
        text = thesis_tables([{"thesis": counts}] * 3)
        self.assertEqual(rows(text, "Table 3.3")[0][-2:], ["20", "19"])

    def test_says_that_ours_are_simulated(self):
        self.assertIn("ours are simulated", thesis_tables([None, None, None]))

    @unittest.skipUnless(THESIS.is_file(), f"skipped: {THESIS} is not there")
    def test_published_numbers_are_the_thesis_own(self):
        text = THESIS.read_text(encoding="utf-8")

        def published(number):
            """Returns the three data rows of a table, without the data set's number."""
            lines = text[text.index(f"Table {number}: "):].splitlines()[1:12]
            data = [re.fullmatch(r"([123])\t([\d\t]+)", line) for line in lines]
            return [tuple(map(int, row[2].split("\t"))) for row in data if row][:3]

        self.assertEqual(published("3.2"), [(p.missed, p.missed_with_fusion) for p in PUBLISHED])
        self.assertEqual(published("3.3"), [
            (p.laser_tracks, p.stereo_tracks, p.parallel_tracks) for p in PUBLISHED])
        self.assertEqual(published("3.4"), [
            (p.false_moving, p.false_moving_with_borders) for p in PUBLISHED])
        self.assertEqual(published("3.5"), [
            (p.intersections, p.intersections_found, p.intersections_false) for p in PUBLISHED])
        moving = re.search(r"True Moving Objects\t(\d+)\t(\d+)\t(\d+)", text).groups()
        self.assertEqual([int(count) for count in moving], [p.moving_objects for p in PUBLISHED])


class Fusion(unittest.TestCase):
    """One data set without and with low-level fusion, and one that failed."""

    def setUp(self):
        alone = {"thesis": COUNTS, "clear_mot": {"mota": 0.5}, "pose": {"end_error_share": 0.0123}}
        fused = dict(alone, thesis=dict(COUNTS, false_moving_objects_frames=0.4))
        stage = {"runs": 10, "mean_s": 0.001}
        half = {"runs": 5, "mean_s": 0.01}  # a camera slower than the scanner
        share = {"percent": [90.0, 95.0], "of": [100, 50]}
        nothing = {"percent": [None, None], "of": [0, 0]}
        grids = {"columns": ["whole grid", "in view"], "paint_gone": share, "bodies_lost": share,
                 "poles_in_lidar": nothing, "poles_in_fused": nothing}
        runs = FusionRuns(alone, fused, {"grid_slam": stage},
                          {"stereo_grid": half, "grid_slam": stage}, grids)
        self.text = fusion_table([runs, None]).splitlines()

    def test_both_runs_are_listed_one_below_the_other(self):
        words = [line.split() for line in self.text]
        self.assertIn(["1", "scanner", "423", "1.26", "6", "42", "15", "50.0", "1.23", "1.0"], words)
        self.assertIn(["1", "fused", "423", "0.40", "6", "42", "15", "50.0", "1.23", "6.0"], words)

    def test_grids_are_counted_in_view(self):
        words = [line.split() for line in self.text]
        self.assertIn(["1", "95.0", "of", "50", "95.0", "of", "50", "-", "-"], words)

    def test_run_without_score_has_no_figures(self):
        words = [line.split() for line in self.text]
        self.assertIn(["2", "fused"] + 8 * ["-"], words)
        self.assertIn(["2"] + 4 * ["-"], words)


class Runs(unittest.TestCase):
    """With programs of a few lines of shell, of which run_bag gives up on the second data set."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.program("simulate", 'echo "$1" > "$2"')
        self.program("run_bag", 'grep -q data_set_2 "$1" && { echo "no map" >&2; exit 1; }\n'
                                'cp "$1" "$2"')
        self.program("score_run", 'while [ "$1" != --out ]; do shift; done\n'
                                  f"echo '{json.dumps({'thesis': COUNTS})}' > \"$2\"")
        for name in ("data_set_1.yaml", "data_set_2.yaml", "data_set_3.yaml", "config.yaml"):
            (self.folder / name).touch()

    def program(self, name, text):
        file = self.folder / name
        file.write_text(f"#!/bin/sh\n{text}\n")
        file.chmod(0o755)

    def run_tool(self, *words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(["--scenes", str(self.folder), "--config", str(self.folder / "config.yaml"),
                         "--programs", str(self.folder), "--out", str(self.folder / "out"), *words])
        return code, out.getvalue(), err.getvalue()

    def test_failed_run_is_reported_and_the_others_continue(self):
        code, out, _ = self.run_tool()
        self.assertEqual(code, 1)
        self.assertIn("data_set_2: no map", out)
        self.assertEqual([row[-1] for row in rows(out, "Table 3.2")], ["6", "-", "6"])
        self.assertTrue((self.folder / "out" / "data_set_3" / "score.json").is_file())

    def test_all_well(self):
        self.program("run_bag", 'cp "$1" "$2"')
        self.assertEqual(self.run_tool()[0], 0)

    def test_fusion_without_grids_is_reported(self):
        self.program("run_bag", 'cp "$1" "$2"; while [ "$1" != --times ]; do shift; done\n'
                                "echo '{}' > \"$2\"")
        code, out, _ = self.run_tool("--low-level-fusion")
        self.assertEqual(code, 1)
        self.assertIn("drive.bag: is not a bag", out)
        self.assertIn("Low-level fusion", out)

    def test_run_without_borders_is_reported(self):
        self.program("run_bag", 'cp "$1" "$2"')
        code, out, _ = self.run_tool("--road-border")
        self.assertEqual(code, 1)
        self.assertIn("data_set_1: ", out)
        self.assertIn("result.bag: is not a bag", out)
        self.assertIn("Borders of the road", out)

    def test_missing_scene_is_named(self):
        (self.folder / "data_set_3.yaml").unlink()
        code, _, err = self.run_tool()
        self.assertEqual(code, 1)
        self.assertIn("data_set_3.yaml: no such file", err)


if __name__ == "__main__":
    unittest.main()
