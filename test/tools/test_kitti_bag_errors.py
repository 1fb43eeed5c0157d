#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""kitti_to_bag refuses what it cannot convert, and leaves no partial bag behind."""

import contextlib
import io
import unittest
from unittest import mock

from kitti_bag_case import Conversion

from datmo_tools.convert.kitti_to_bag import main


class Errors(Conversion):
    def assert_refused(self, *texts, options=()):
        """Expects exit code 1, all texts in the message, and no file left behind."""
        said = self.run_tool(*options, expected_code=1)
        for text in texts:
            self.assertIn(text, said)
        self.assertEqual([path.name for path in self.root.iterdir()], ["2011_09_26"])

    def test_truncated_file(self):
        path = self.drive / "velodyne_points" / "data" / "0000000003.bin"
        path.write_bytes(path.read_bytes()[:-1])
        self.assert_refused(str(path), "15 bytes, expected a multiple of 16")

    def test_unreadable_image(self):
        path = self.drive / "image_01" / "data" / "0000000002.png"
        path.write_bytes(b"no image")
        self.assert_refused(str(path), "expected a gray PNG of 8 x 4", options=["--images"])

    def test_missing_scan(self):
        (self.drive / "velodyne_points" / "data" / "0000000001.bin").unlink()
        self.assert_refused("0000000001.bin is missing", "--allow-missing-scans")

    def test_counts_that_do_not_match(self):
        (self.drive / "oxts" / "data" / "0000000003.txt").unlink()
        stamps = self.drive / "oxts" / "timestamps.txt"
        stamps.write_text("".join(stamps.read_text().splitlines(keepends=True)[:3]))
        self.assert_refused(str(stamps), "3 stamps, expected 4")

    def test_frames_that_the_drive_does_not_have(self):
        self.assert_refused("expected 0 <= START < END <= 4", options=["--end", "5"])
        self.assert_refused("frames 3 to 3", options=["--start", "3", "--end", "3"])

    def test_options(self):
        self.assert_refused("--scan-resolution is -1", options=["--scan-resolution", "-1"])
        self.assert_refused("--odometry-yaw-noise is -1, expected 0 or more", options=["--odometry-yaw-noise", "-1"])
        self.assert_refused("--seed is -1", options=["--seed", "-1"])

    def test_bag_that_cannot_be_written(self):
        self.bag = self.root / "no" / "out.bag"
        self.assert_refused(str(self.bag), "cannot be written")

    def test_folder_is_no_output_bag(self):
        self.bag = self.drive
        self.assert_refused(f"{self.drive}: is a folder")

    def test_no_scan_at_all(self):
        for path in (self.drive / "velodyne_points" / "data").iterdir():
            path.unlink()
        self.assert_refused("(4 of 4)", options=["--allow-missing-scans"])

    def test_interruption(self):
        with mock.patch("datmo_tools.convert.kitti_raw.Drive.cloud", side_effect=KeyboardInterrupt):
            self.assert_refused("interrupted, no bag written")

    def test_nan_option(self):
        with contextlib.redirect_stderr(io.StringIO()) as said, self.assertRaises(SystemExit):
            main([str(self.drive), str(self.bag), "--scan-resolution", "fine"])
        self.assertIn("--scan-resolution: 'fine', expected a finite number", said.getvalue())

    def test_images_without_opencv(self):
        with mock.patch.dict("sys.modules", cv2=None):
            self.assert_refused("expected Debian's python3-opencv", options=["--images"])

    def test_earlier_bag_survives_a_failure(self):
        self.run_tool()
        before = self.bag.read_bytes()
        (self.drive / "velodyne_points" / "data" / "0000000003.bin").write_bytes(b"1")
        self.run_tool(expected_code=1)
        self.assertEqual(self.bag.read_bytes(), before)
        self.assertEqual(
            sorted(path.name for path in self.root.iterdir()), ["2011_09_26", "out.bag"]
        )


if __name__ == "__main__":
    unittest.main()
