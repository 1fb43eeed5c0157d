#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Which files check_bag writes, and which it does not overwrite; that it ends at all with huge numbers."""

import contextlib
import io
import os
import unittest

import simulated_recording as simulated
from check_bag_case import Tool, of_topic

from datmo_tools.check_bag.main import main


class Output(Tool):
    def setUp(self):
        super().setUp()
        simulated.write(self.bag, simulated.recording())
        self.recorded = self.bag.read_bytes()

    def said(self, *words, code):
        """Returns the standard error."""
        errors = io.StringIO()
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(errors):
            self.assertEqual(main([str(self.bag), *map(str, words)]), code, errors.getvalue())
        return errors.getvalue()

    def test_the_bag_is_not_overwritten(self):
        link = self.folder / "link.yaml"
        link.symlink_to(self.bag)
        for out in (self.bag, link):
            for words in ((), ("--force",)):
                said = self.said("--out", out, *words, code=1)
                self.assertIn(f"{out}: is the bag itself, expected another name of the yaml", said)
        self.assertEqual(self.bag.read_bytes(), self.recorded)

    def test_an_existing_yaml_is_overwritten_only_with_force(self):
        self.yaml.write_text("mine: 1\n")
        said = self.said("--out", self.yaml, code=1)
        self.assertIn(f"{self.yaml}: exists, expected the name of a new file; to overwrite it: --force", said)
        self.said("--out", self.yaml, "--no-yaml", code=0)
        self.assertEqual(self.yaml.read_text(), "mine: 1\n")
        self.said("--out", self.yaml, "--force", code=0)
        self.assertNotIn("mine", self.yaml.read_text())

    def test_the_default_name_is_protected_too(self):
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder)
        self.said(code=0)
        self.assertTrue((self.folder / "drive.yaml").is_file())
        self.assertIn("drive.yaml: exists", self.said(code=1))


class FlippedBits(Tool):
    """One bit of a number makes it huge: it must not be the size of an array, nor overflow."""

    def test_stray_stamp(self):
        items = simulated.recording()
        of_topic(items, "/odometry")[-1].message.header.stamp = simulated.ros_time(2.6e9)
        self.assertIn("Measured", self.run_tool(items)[1])

    def test_huge_quaternion(self):
        items = simulated.recording()
        of_topic(items, "/odometry")[100].message.pose.pose.orientation.x = 1e200
        self.assertIn("Measured", self.run_tool(items)[1])


if __name__ == "__main__":
    unittest.main()
