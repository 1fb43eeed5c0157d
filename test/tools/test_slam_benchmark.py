#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""slam_benchmark without the stack: which files it uses, its table, rejected input."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from datmo_tools.errors import InputError
from datmo_tools.experiments.slam_benchmark import find_pairs, main, table


def figures(mean):
    """Returns a score whose figures are all the same."""
    return {"mean": mean, "std": mean, "max": mean}


def result(log):
    """Returns a log's result."""
    scored = {
        "used": 2,
        "not_covered": 1,
        "translation_m": figures(0.125),
        "rotation_deg": figures(1.5),
    }
    time = {"runs": 100, "mean_s": 0.0005, "median_s": 0.0004, "percentile_99_s": 0.002}
    return {
        "log": log,
        "pose": scored,
        "loops_closed": {**scored, "translation_m": figures(0.0625)},
        "odometry": scored,
        "time": time,
        "time_of_loops": time,
    }


class Benchmark(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)

    def make(self, *names):
        for name in names:
            (self.root / name).touch()

    def assert_refused(self, *files, text):
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            options = ["--programs", str(self.root), "--config", str(self.root / "indoor.yaml")]
            self.assertEqual(main([*map(str, files), *options]), 1)
        self.assertIn(text, said.getvalue())

    def test_logs_with_relations(self):
        self.make("a.clf", "b.log", "b.relations", "c.clf.bz2", "c.relations", "README")
        pairs = [(log.name, relations.name) for log, relations in find_pairs(self.root)]
        self.assertEqual(pairs, [("b.log", "b.relations"), ("c.clf.bz2", "c.relations")])

    def test_folder_without_relations(self):
        self.make("a.clf")
        with self.assertRaisesRegex(InputError, "no log with relations"):
            find_pairs(self.root)

    def test_published_figures_are_listed_beside_their_log(self):
        text = table([result("intel"), result("elsewhere")])
        ours, other = text.split("elsewhere", 1)
        self.assertIn("0.070 +- 0.083", ours)
        self.assertIn("0.125 +- 0.125", ours)
        self.assertRegex(ours, r"intel, loop_closing +0\.062 \+- 0\.062")
        self.assertRegex(ours, r"0\.500 +0\.400 +2\.000")
        self.assertNotIn("0.070", other)
        self.assertIn("2/3", other)

    def test_rejected_input(self):
        self.assert_refused("a", "b", "c", text="3 files, expected LOG RELATIONS pairs")
        self.make("a.clf", "a.relations")
        self.assert_refused(self.root, text="run_bag: no such program")
        self.make("run_bag")
        pair = self.root / "a.clf", self.root / "a.relations"
        self.assert_refused(*pair, text="indoor.yaml: no such file")
        self.make("indoor.yaml")
        self.assert_refused(*pair, text=f"{pair[1]}: no relation in it")
        pair[1].write_text("1 2 0 0 0 0 0 0\n", encoding="ascii")
        self.assert_refused(*pair, text=f"{pair[0]}: no line of FLASER")


if __name__ == "__main__":
    unittest.main()
