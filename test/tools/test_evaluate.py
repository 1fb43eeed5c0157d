#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The command line of evaluate, with a stand-in for score_run that copies a score."""

import contextlib
import io
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from datmo_tools.errors import InputError
from datmo_tools.evaluate.main import main
from datmo_tools.evaluate.score_run import find_score_run
from datmo_tools.whole_files import write_whole
from evaluation_sample import sample_run

# Notes its arguments; a run's file holds its score, or an error message and an exit code.
STAND_IN = """#!/usr/bin/python3
import json, sys
from pathlib import Path
words = sys.argv[1:]
with open(Path(__file__).with_name("calls"), "a") as calls:
    calls.write(json.dumps(words[:-1]) + chr(10))
scored = Path(words[0]).read_text()
if scored.startswith("fail"):
    print("stand-in: no /tracks", file=sys.stderr)
    sys.exit(int(scored.split()[1]))
assert words[-2] == "--out"
Path(words[-1]).write_text(scored)
"""

WITHOUT_MATPLOTLIB = """
import sys
sys.modules["matplotlib"] = None
from datmo_tools.evaluate.main import main
main(["draw_borders", "/nowhere/run.bag"])
main(["slam", "/nowhere/run.bag", "/nowhere/relations"])
"""


class CommandLine(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.program = self.folder / "score_run"
        self.program.write_text(STAND_IN)
        self.program.chmod(0o755)
        self.out = self.folder / "report"

    def bag(self, name, **changes):
        path = self.folder / name
        path.write_text(json.dumps(sample_run(str(path), **changes)))
        return path

    def evaluate(self, *words, subcommand="tracks"):
        """Exit code, standard output, standard error."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                words = [subcommand, *map(str, words), "--out", str(self.out)]
                code = main(words, str(self.program))
            except SystemExit as ending:
                code = ending.code
        return code, out.getvalue(), err.getvalue()

    def calls(self):
        return [json.loads(line) for line in (self.folder / "calls").read_text().splitlines()]

    def test_one_run(self):
        bag = self.bag("a.bag")
        code, out, _ = self.evaluate(bag)
        self.assertEqual(code, 0)
        self.assertIn("MOTA", out)
        self.assertIn(str(self.out / "tracks.html"), out)
        self.assertEqual(
            sorted(path.name for path in self.out.iterdir()), ["tracks.html", "tracks.json"]
        )
        report = json.loads((self.out / "tracks.json").read_text())
        self.assertEqual(report, {"format": 1, "runs": [sample_run(str(bag))]})
        self.assertEqual(self.calls(), [[str(bag), "--out"]])

    def test_attainable_delays_are_asked_of_score_run(self):
        bag = self.bag("a.bag")
        self.assertEqual(self.evaluate(bag, "--attainable", "drive.bag")[0], 0)
        self.assertEqual(self.calls(), [[str(bag), "--attainable", "drive.bag", "--out"]])

    def test_truth_and_options_are_passed_on(self):
        bag = self.bag("a.bag")
        options = ["--options", "o.yaml", "--set", "region/range=30", "--set", "align=none"]
        self.evaluate(bag, "--truth", "t.bag", *options)
        self.assertEqual(self.calls(), [[str(bag), "t.bag", *options, "--out"]])

    def test_runs_side_by_side(self):
        better = self.bag("b.bag", clear_mot={"mota": 0.6})
        code, out, _ = self.evaluate("--compare", self.bag("a.bag"), better)
        self.assertEqual(code, 0)
        mota = next(line for line in out.splitlines() if line.startswith("MOTA"))
        self.assertEqual(mota.split(), ["MOTA", "%", "40.0", "60.0*"])
        report = json.loads((self.out / "tracks.json").read_text())
        self.assertEqual([run["clear_mot"]["mota"] for run in report["runs"]], [0.4, 0.6])

    def test_runs_on_different_drives(self):
        other = self.bag("b.bag", objects=3)
        code, out, err = self.evaluate("--compare", self.bag("a.bag"), other)
        self.assertEqual((code, out), (1, ""))
        self.assertIn("b.bag: 3 true objects, different from the 2 of", err)
        self.assertFalse(self.out.exists())

    def test_failure_of_score_run_is_ours_and_leaves_nothing(self):
        bad = self.folder / "bad.bag"
        for code in (2, 7):
            bad.write_text(f"fail {code}")
            self.assertEqual(self.evaluate("--compare", self.bag("a.bag"), bad)[:2], (code, ""))
            self.assertFalse(self.out.exists())

    def test_failure_leaves_the_previous_report(self):
        self.evaluate(self.bag("a.bag"))
        before = (self.out / "tracks.html").read_bytes()
        bad = self.folder / "bad.bag"
        bad.write_text("fail 2")
        self.evaluate(bad)
        self.assertEqual((self.out / "tracks.html").read_bytes(), before)

    def test_same_input_same_bytes(self):
        pages = []
        for _ in range(2):
            self.evaluate(self.bag("a.bag"))
            pages.append((self.out / "tracks.html").read_bytes())
        self.assertTrue(pages[0] == pages[1])

    def test_wrong_usage(self):
        for words in ([], ["a.bag", "--compare", "b.bag"], ["a.bag", "--fast"]):
            code, out, err = self.evaluate(*words)
            self.assertEqual((code, out), (2, ""))
            self.assertIn("usage: evaluate", err)

    def test_matplotlib_is_needed_only_to_draw(self):
        done = subprocess.run([sys.executable, "-c", WITHOUT_MATPLOTLIB], check=True, capture_output=True, text=True)
        drawn, scored = done.stderr.splitlines()
        self.assertIn("expected the package python3-matplotlib", drawn)
        self.assertIn("/nowhere/relations: expected a relations file", scored)

    def test_format_of_another_version(self):
        code, _, err = self.evaluate(self.bag("a.bag", format=9))
        self.assertEqual(code, 1)
        self.assertIn("format 9, expected 1", err)
        self.assertFalse(self.out.exists())

    def test_folder_that_is_a_file(self):
        self.out.write_text("mine")
        code, out, err = self.evaluate(self.bag("a.bag"))
        self.assertEqual((code, out), (2, ""))
        self.assertIn(str(self.out), err)
        self.assertEqual(self.out.read_text(), "mine")


class FindScoreRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.tool = self.folder / "evaluate"
        environment = {"PATH": str(self.folder / "none"), "CMAKE_PREFIX_PATH": str(self.folder)}
        patch = mock.patch.dict(os.environ, environment)
        patch.start()
        self.addCleanup(patch.stop)

    def make_program(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        program = folder / "score_run"
        program.touch(mode=0o755)
        return str(program)

    def test_not_found_anywhere(self):
        with self.assertRaisesRegex(InputError, "score_run is not beside .*source setup.bash"):
            find_score_run(self.tool)

    def test_a_tool_of_the_source_tree_finds_it_in_the_sourced_workspace(self):
        program = self.make_program(self.folder / "lib" / "datmo_fusion")
        self.assertEqual(find_score_run(self.tool), program)

    def test_beside_the_tool_comes_first(self):
        self.make_program(self.folder / "lib" / "datmo_fusion")
        program = self.make_program(self.folder)
        self.assertEqual(find_score_run(self.tool), program)

    def test_on_path_last(self):
        program = self.make_program(self.folder / "none")
        self.assertEqual(find_score_run(self.tool), program)


class WholeFiles(unittest.TestCase):
    def test_all_or_none(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name) / "new"
            write_whole(folder, {"a": "1", "b": "2"})
            self.assertEqual((folder / "a").read_text() + (folder / "b").read_text(), "12")
            (folder / "c.part").mkdir()  # c cannot be written
            with self.assertRaisesRegex(InputError, "new: cannot be written"):
                write_whole(folder, {"a": "changed", "c": "3"})
            self.assertEqual((folder / "a").read_text(), "1")
            self.assertEqual(sorted(path.name for path in folder.iterdir()), ["a", "b", "c.part"])


if __name__ == "__main__":
    unittest.main()
