#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The robustness benchmark: its summary, worked out by hand,
and its runs with stand-in programs."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

from datmo_tools.experiments.robustness import main
from datmo_tools.experiments.robustness_summary import summarize, table


def run(movers, seed, jump, at_10, at_70=None, scene="road"):
    relative = [
        {"distance_m": 10.0, "translation_m": at_10, "rotation_deg": 0.5, "pairs": 3},
        {"distance_m": 70.0, "translation_m": at_70, "rotation_deg": None, "pairs": 0},
    ]
    if at_70 is not None:
        relative[1].update(rotation_deg=1.5, pairs=2)
    pose = {"largest_jump_m": jump, "relative": relative}
    return {"scene": scene, "movers": movers, "seed": seed, "error": None, "pose": pose}


class Summary(unittest.TestCase):
    def test_failures_errors_and_ratio(self):
        # Without movers the error at 10 m is (0.1 + 0.3) / 2 = 0.2, with them (0.2 + 0.4) / 2 = 0.3.
        summary = summarize([
            run(0, 1, 0.1, 0.1, 0.5), run(0, 2, 0.2, 0.3),
            run(8, 1, 1.0, 0.2), run(8, 2, 1.5, 0.4),
        ])
        still, moving = summary
        self.assertEqual((still["failed"], still["worst_jump_m"]), (0, 0.2))
        self.assertEqual((moving["failed"], moving["failed_seeds"]), (1, [2]))  # more than 1 m
        self.assertEqual(moving["failure_rate"], 0.5)
        self.assertAlmostEqual(moving["relative"][0]["translation_m"], 0.3)
        self.assertAlmostEqual(moving["relative"][0]["ratio"], 1.5)
        self.assertEqual([error["distance_m"] for error in moving["relative"]], [10.0])
        self.assertEqual(still["relative"][1]["translation_m"], 0.5)

    def test_run_without_score_is_no_failure_of_the_pose(self):
        broken = {"scene": "road", "movers": 0, "seed": 2, "error": "no", "pose": None}
        row = summarize([run(0, 1, 2.0, 0.1), broken])[0]
        self.assertEqual((row["runs"], row["without_score"], row["failure_rate"]), (1, 1, 1.0))

    def test_nothing_scored(self):
        broken = {"scene": "road", "movers": 0, "seed": 2, "error": "no", "pose": None}
        row = summarize([broken])[0]
        self.assertEqual((row["failure_rate"], row["worst_jump_m"], row["relative"]),
                         (None, None, []))
        self.assertEqual(table([row]).splitlines()[1].split(), ["road", "0", "0", "0", "-", "-"])

    def test_scenes_are_compared_with_themselves(self):
        summary = summarize([run(0, 1, 0.1, 0.1), run(8, 1, 0.1, 0.2, scene="rails"),
                             run(0, 1, 0.1, 0.4, scene="rails")])
        self.assertAlmostEqual(summary[1]["relative"][0]["ratio"], 0.5)

    def test_table(self):
        text = table(summarize([run(0, 1, 0.1, 0.1, 0.5), run(16, 1, 1.25, 0.2, 0.5)]))
        heading, still, moving = text.splitlines()
        self.assertEqual(len({len(heading), len(still), len(moving)}), 1)
        self.assertEqual(moving.split(), ["road", "16", "1", "1", "100%", "1.25", "m",
                                          "0.200", "m", "2.00", "0.500", "m", "1.00"])


SCORE = '{"pose": {"largest_jump_m": 0.5, "relative": []}}'


class Runs(unittest.TestCase):
    """With programs of a few lines of shell, of which run_bag gives up on seed 2."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.program("simulate", 'echo "$@" > "$2"')
        self.program("run_bag", 'grep -q seed=2 "$1" && { echo "no map" >&2; exit 1; }\n'
                                'cp "$1" "$2"')
        self.program("score_run", f"echo '{SCORE}' > \"$3\"")
        for name in ("road.yaml", "config.yaml"):
            (self.folder / name).touch()

    def program(self, name, text):
        file = self.folder / name
        file.write_text(f"#!/bin/sh\n{text}\n")
        file.chmod(0o755)

    def benchmark(self, *words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main([str(self.folder / "road.yaml"), "--config",
                         str(self.folder / "config.yaml"), "--programs", str(self.folder),
                         "--out", str(self.folder / "out.json"), *words])
        return code, out.getvalue(), err.getvalue()

    def test_failed_run_is_reported_and_the_others_continue(self):
        code, out, _ = self.benchmark("--seeds", "3", "--movers", "0", "4")
        self.assertEqual(code, 1)
        self.assertIn("road, 4 movers, seed 2: no map", out)
        report = json.loads((self.folder / "out.json").read_text())
        self.assertEqual([(run["movers"], run["seed"], run["pose"] is None)
                          for run in report["runs"]],
                         [(0, 1, False), (0, 2, True), (0, 3, False),
                          (4, 1, False), (4, 2, True), (4, 3, False)])

    def test_all_well(self):
        code, out, _ = self.benchmark("--seeds", "1", "--movers", "0")
        self.assertEqual(code, 0)
        self.assertIn("0.50 m", out)

    def test_no_seeds_and_no_jobs_are_refused(self):
        for name in ("--seeds", "--jobs"):
            with self.assertRaises(SystemExit) as ended:
                self.benchmark(name, "0")
            self.assertEqual(ended.exception.code, 2)

    def test_missing_files_are_named(self):
        (self.folder / "run_bag").unlink()
        code, _, err = self.benchmark()
        self.assertEqual(code, 1)
        self.assertIn("run_bag: no such program", err)
        (self.folder / "road.yaml").unlink()
        self.assertIn("road.yaml: no such file", self.benchmark()[2])
        self.assertFalse((self.folder / "out.json").exists())


if __name__ == "__main__":
    unittest.main()
