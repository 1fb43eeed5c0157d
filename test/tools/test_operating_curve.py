#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate operating_curve, with stand-ins for run_bag and score_run."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

from datmo_tools.evaluate.main import main
from datmo_tools.evaluate.operating_curve import (
    rates,
    shipped_probability,
    with_probability,
)

# The run of a drive is the probability that its preset requires.
RUN_BAG = """#!/usr/bin/python3
import json, sys, yaml
from pathlib import Path
words = sys.argv[1:]
with open(Path(__file__).with_name("calls"), "a") as calls:
    calls.write(json.dumps(words) + chr(10))
if Path(words[0]).name == "bad.bag":
    sys.exit("stand-in: no scans")
preset = yaml.safe_load(Path(words[words.index("--preset") + 1]).read_text())
target = preset["tracker"]["target"]
Path(words[1]).write_text(str(target["motion_likelihood"]["required_probability"]))
"""

# Of 200 frames it misses as many per cent as is required, and has 10 false tracks at 0.5 in 30 s.
SCORE_RUN = """#!/usr/bin/python3
import json, sys
from pathlib import Path
required = float(Path(sys.argv[1]).read_text())
Path(sys.argv[-1]).write_text(json.dumps({
    "format": 1, "duration_s": 30.0, "options": {"attainable/required_probability": 0.8},
    "clear_mot": {"misses": round(200 * required), "required": 200},
    "thesis": {"false_tracks": round(20 * (1.0 - required))}}))
"""


class Settings(unittest.TestCase):
    def test_the_preset_keeps_its_other_values(self):
        preset = {"tracker": {"target": {"a": 1}}, "b": 2}
        changed = with_probability(preset, 0.9)
        self.assertEqual(
            changed,
            {"tracker": {"target": {"a": 1, "motion_likelihood": {"required_probability": 0.9}}},
             "b": 2},
        )  # fmt: skip
        self.assertEqual(preset, {"tracker": {"target": {"a": 1}}, "b": 2})

    def test_the_last_file_that_names_it_is_shipped(self):
        self.assertIsNone(shipped_probability([]))
        files = [with_probability({}, 0.6), {"tracker": None}]
        self.assertEqual(shipped_probability(files), 0.6)
        self.assertEqual(shipped_probability([*files, with_probability({}, 0.7)]), 0.7)

    def test_rates_are_of_all_frames_and_minutes(self):
        short = {"misses": 1, "required": 10, "false_tracks": 3, "duration_s": 30.0}
        long = {"misses": 2, "required": 90, "false_tracks": 0, "duration_s": 150.0}
        self.assertEqual(
            rates([short, long]), {"missed_share": 0.03, "false_tracks_per_minute": 1.0}
        )
        nothing = {"misses": 0, "required": 0, "false_tracks": 0, "duration_s": 0.0}
        self.assertEqual(set(rates([nothing]).values()), {None})


class CommandLine(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        for name, text in (("run_bag", RUN_BAG), ("score_run", SCORE_RUN)):
            (self.folder / name).write_text(text)
            (self.folder / name).chmod(0o755)
        self.config = self.folder / "config.yaml"
        self.config.write_text("grid_slam: {}\n")
        self.out = self.folder / "report"

    def evaluate(self, *words):
        """Exit code, standard output, standard error."""
        out, err = io.StringIO(), io.StringIO()
        words = ["operating_curve", *words, "--config", self.config, "--out", self.out,
                 "--run-bag", self.folder / "run_bag"]  # fmt: skip
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(list(map(str, words)), str(self.folder / "score_run"))
        return code, out.getvalue(), err.getvalue()

    def test_curve(self):
        words = ("a.bag", "b.bag", "--road-border", "--probabilities", "0.9", "0.5")
        code, out, err = self.evaluate(*words)
        self.assertEqual((code, err), (0, ""))
        result = json.loads((self.out / "operating_curve.json").read_text())
        self.assertEqual(result["shipped"], 0.8)
        points = result["points"]
        self.assertEqual([point["probability"] for point in points], [0.5, 0.8, 0.9])
        self.assertEqual([point["missed_share"] for point in points], [0.5, 0.8, 0.9])
        self.assertEqual([point["false_tracks_per_minute"] for point in points], [20.0, 8.0, 4.0])
        self.assertEqual(points[0]["drives"][1]["drive"], "b.bag")
        self.assertIn("0.8 (shipped)", out)
        self.assertTrue((self.out / "operating_curve.png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn("<svg", (self.out / "operating_curve.html").read_text())
        calls = (self.folder / "calls").read_text().splitlines()
        self.assertEqual(len(calls), 6)
        self.assertTrue(all("--road-border" in json.loads(call) for call in calls))

    def test_drives_of_one_name_are_told_apart(self):
        _, out, _ = self.evaluate("left/drive.bag", "right/drive.bag", "--probabilities", "0.5")
        self.assertIn("left/drive: missed, %", out)
        page = (self.out / "operating_curve.html").read_text()
        for name in ("left/drive", "right/drive"):
            self.assertIn(f">{name}</text>", page)

    def test_invalid_presets(self):
        """They are reported before anything runs."""
        preset = self.folder / "preset.yaml"
        for text, said in (("tracker: 3", "tracker is 3, expected a mapping of options"),
                           ("tracker: {target: {motion_likelihood: {required_probability: low}}}",
                            "required_probability is low, expected a number")):  # fmt: skip
            preset.write_text(text)
            code, _, err = self.evaluate("a.bag", "--preset", preset)
            self.assertEqual(code, 1)
            self.assertIn(said, err)
        self.assertFalse((self.folder / "calls").exists())

    def test_missing_program(self):
        (self.folder / "run_bag").unlink()
        code, _, err = self.evaluate("a.bag")
        self.assertEqual(code, 1)
        self.assertIn("run_bag: cannot be run: No such file or directory", err)

    def test_invalid_requests(self):
        code, _, err = self.evaluate("a.bag", "--probabilities", "1.2")
        self.assertEqual(code, 1)
        self.assertIn("1.2", err)
        code, _, err = self.evaluate("bad.bag", "--probabilities", "0.5")
        self.assertEqual(code, 1)
        self.assertIn("stand-in: no scans", err)
        self.config.write_text("- a list\n")
        code, _, err = self.evaluate("a.bag", "--probabilities", "0.5")
        self.assertEqual(code, 1)
        self.assertIn("expected a mapping", err)
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
