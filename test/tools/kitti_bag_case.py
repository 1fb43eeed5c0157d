# SPDX-License-Identifier: BSD-3-Clause
"""kitti_to_bag on a made-up drive, for its tests."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import rosbag
import tiny_drive
from datmo_tools.convert.kitti_to_bag import main


class Conversion(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        # The van's rear is 10 m ahead of the Velodyne in every frame, and the cloud's point is on
        # it.
        self.drive = tiny_drive.make_drive(temporary.name)
        self.bag = self.root / "out.bag"

    def run_tool(self, *options, expected_code=0):
        """Runs the tool without a subprocess; returns its standard error."""
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            code = main([str(self.drive), str(self.bag), *options])
        self.assertEqual(code, expected_code, errors.getvalue())
        return errors.getvalue()

    def messages(self, topic):
        with rosbag.Bag(str(self.bag)) as bag:
            return [message for _, message, _ in bag.read_messages([topic])]
