#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""One camera beside the scanner on the recorded drive: no worse tracks than without it."""

import contextlib
import io
import json
import subprocess
import tempfile
import unittest
from pathlib import Path

import yaml
from datmo_tools import programs
from datmo_tools.convert.kitti_to_bag import main
from drive_0005 import DATA, DRIVE, needs_drive_0005

CONFIG = Path(__file__).resolve().parents[2] / "config" / "kitti.yaml"
MODEL = DATA.parent / "models" / "yolo-fastest-1.1-xl" / "yolo-fastest-1.1-xl.weights"

# KITTI's labels know the camera's view alone, and not which sensor sees what.
SCORING = ("truth/min_time_seen=0", "truth/visible_to=none", "region/range=500",
           "region/half_angle=0.7")  # fmt: skip


def run(program, *arguments):
    subprocess.run([programs.find(program, __file__), *map(str, arguments)],
                   check=True, stdout=subprocess.DEVNULL)  # fmt: skip


def report_of(folder, drive, name, *options):
    """What score_run says of a run of the drive."""
    result, report = folder / f"{name}.bag", folder / f"{name}.json"
    run("run_bag", drive, result, "--config", CONFIG, "--quiet", *options)
    sets = [word for option in SCORING for word in ("--set", option)]
    run("score_run", result, drive, *sets, "--out", report)
    return json.loads(report.read_text())


@needs_drive_0005
@unittest.skipUnless(MODEL.is_file(), f"needs a network, which is not in {MODEL}")
class MonoDrive0005(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        folder = Path(folder.name)
        with contextlib.redirect_stderr(io.StringIO()):
            assert main([str(DRIVE), str(folder / "drive.bag"), "--images"]) == 0
        dnn = {"mono_classifier": {"detector": "dnn", "dnn": {"model": str(MODEL)}}}
        (folder / "dnn.yaml").write_text(yaml.safe_dump(dnn))
        mono = ("--mono", "--preset", folder / "dnn.yaml")
        cls.alone = report_of(folder, folder / "drive.bag", "alone")
        cls.with_mono = report_of(folder, folder / "drive.bag", "mono", *mono)

    def test_tracks_are_no_worse(self):
        alone, with_mono = self.alone["clear_mot"], self.with_mono["clear_mot"]
        self.assertGreaterEqual(with_mono["mota"], alone["mota"])
        self.assertLessEqual(with_mono["id_switches"], alone["id_switches"])

    def test_classes_are_no_worse(self):
        alone, with_mono = self.alone["classes"], self.with_mono["classes"]
        self.assertGreaterEqual(with_mono["right_share"], alone["right_share"])


if __name__ == "__main__":
    unittest.main()
