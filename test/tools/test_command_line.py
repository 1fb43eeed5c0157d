#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Common to all tools: unwritable outputs and missing modules are reported at once."""

import argparse
import contextlib
import io
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from datmo_tools.command_line import output_file, output_folder
from datmo_tools.launcher import missing, run_tool

TOOLS = Path(__file__).resolve().parents[2] / "tools"


class Outputs(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        (self.root / "file").write_text("")

    def assert_refused(self, kind, path, text):
        with self.assertRaisesRegex(argparse.ArgumentTypeError, text):
            kind(str(path))

    def test_files_and_folders_that_can_be_made(self):
        new = self.root / "new" / "newer"
        self.assertEqual(output_folder(str(new)), new)
        self.assertEqual(output_file(str(new / "report.json")), new / "report.json")
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.root)
        self.assertEqual(output_file("report.json"), Path("report.json"))
        self.assertFalse(new.exists())

    def test_unwritable_outputs(self):
        self.assert_refused(output_file, self.root, "is a folder, expected the name of a file")
        self.assert_refused(output_file, self.root / "file" / "report.json", "file is no folder")
        self.assert_refused(output_folder, self.root / "file", "file is no folder")

    @unittest.skipIf(os.geteuid() == 0, "root may write in every folder")
    def test_permission(self):
        self.root.chmod(0o500)
        self.assert_refused(output_file, self.root / "report.json", "no permission to write in")
        self.root.chmod(0o700)

    def test_tools_report_it_before_they_read(self):
        said = io.StringIO()
        with contextlib.redirect_stderr(said), self.assertRaises(SystemExit):
            options = ["/nowhere.bag", "/nowhere.bag", "--json", str(self.root)]
            with mock.patch.object(sys, "argv", ["evaluate", "compare_borders", *options]):
                run_tool("evaluate", "evaluate.main")
        self.assertIn("--json", said.getvalue())
        self.assertIn("is a folder", said.getvalue())


class Modules(unittest.TestCase):
    def test_packages(self):
        self.assertIn("package python3-opencv", missing("cv2"))
        self.assertIn("package python3-matplotlib", missing("matplotlib.figure"))
        self.assertIn("package python3-sensor-msgs", missing("sensor_msgs"))
        self.assertIn("source devel/setup.bash", missing("datmo_fusion.msg"))

    def test_one_line_instead_of_a_traceback(self):
        said = io.StringIO()
        error = ModuleNotFoundError("No module named 'rosbag'", name="rosbag")
        with contextlib.redirect_stderr(said), mock.patch("importlib.import_module",
                                                          side_effect=error):  # fmt: skip
            self.assertEqual(run_tool("check_bag", "check_bag.main"), 1)
        self.assertEqual(said.getvalue(), "check_bag: Python module rosbag not found, expected "
                                          "Debian's package python3-rosbag\n")  # fmt: skip

    def test_tool_without_a_program(self):
        words = [sys.executable, "-m", "datmo_tools", "experiments.robustness", "--help"]
        done = subprocess.run(words, check=True, capture_output=True, text=True)
        self.assertIn("usage: robustness", done.stdout)

    def test_every_tool_is_started_this_way(self):
        for path in TOOLS.glob("*/*"):
            if path.is_file() and not path.suffix and "datmo_tools" in path.read_text():
                self.assertIn(f'run_tool("{path.name}"', path.read_text())


if __name__ == "__main__":
    unittest.main()
