#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""KITTI raw drives in every published form, made after the devkit's readme."""

import contextlib
import io
import shutil
import tempfile
import unittest
from pathlib import Path

import numpy as np
import rosbag
import tiny_drive
from datmo_fusion.msg import Object
from datmo_tools.convert.kitti_to_bag import main

TYPES = {
    "Car": Object.CLASS_VEHICLE,
    "Van": Object.CLASS_VEHICLE,
    "Truck": Object.CLASS_VEHICLE,
    "Tram": Object.CLASS_VEHICLE,
    "Pedestrian": Object.CLASS_PEDESTRIAN,
    "Person": Object.CLASS_PEDESTRIAN,
    "Person_sitting": Object.CLASS_PEDESTRIAN,
    "Person (sitting)": Object.CLASS_PEDESTRIAN,
    "Cyclist": Object.CLASS_CYCLIST,
    "Misc": Object.CLASS_UNKNOWN,
}
LABEL = "{frame} {number} {label} 0 0 -1.5 1 2 3 4 1.8 0.6 2.0 -3.0 1.5 10.0 0.0\n"


class Conversion(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        self.bag = self.root / "out.bag"
        self.drive = self.make()

    def make(self):
        return tiny_drive.make_drive(self.root)

    def convert(self, *options, code=0):
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            self.assertEqual(main([str(self.drive), str(self.bag), *options]), code, errors)
        return errors.getvalue()

    def messages(self, topic):
        with rosbag.Bag(str(self.bag)) as bag:
            return [message for _, message, _ in bag.read_messages([topic])]

    def stamps(self, topic):
        """Returns the stamps of its messages, in ms after the first frame."""
        begin = 1317042272_000_000_000
        return [round((m.header.stamp.to_nsec() - begin) * 1e-6) for m in self.messages(topic)]

    def edit_lines(self, kind, **lines):
        """Replaces lines (`line_2="..."`) of a sensor's timestamps.txt by other text."""
        path = self.drive / kind / "timestamps.txt"
        text = path.read_text().splitlines()
        for name, line in lines.items():
            text[int(name.removeprefix("line_"))] = line
        path.write_text("\n".join(text) + "\n")

    def lose(self, kind, index, suffix):
        (self.drive / kind / "data" / f"{index:010d}{suffix}").unlink()


class Synchronized(Conversion):
    def test_scan_lost_with_its_stamp(self):
        """Drive 2011_09_26_0009 as downloaded: a blank line, and no file."""
        self.edit_lines("velodyne_points", line_2="")
        self.lose("velodyne_points", 2, ".bin")
        said = self.convert(code=1)
        self.assertIn("0000000002.bin is missing", said)
        self.assertIn("(1 of 4)", said)
        self.assertIn("1 of 4 scans are missing", self.convert("--allow-missing-scans", "--images"))
        self.assertEqual(len(self.messages("/scan")), 3)
        self.assertEqual(self.stamps("/ground_truth/objects"), [0, 100, 300])
        self.assertEqual(len(self.messages("/odometry")), 4)
        self.assertEqual(len(self.messages("/stereo/left/image_rect")), 4)
        van = self.messages("/ground_truth/objects")[2].objects[0]
        self.assertAlmostEqual(van.pose.position.x, 3.0 + 0.8 + 12.0, places=6)

    def test_last_scan_lost(self):
        self.edit_lines("velodyne_points", line_3="")
        self.lose("velodyne_points", 3, ".bin")
        self.convert("--allow-missing-scans")
        self.assertEqual(len(self.messages("/scan")), 3)

    def test_motion_record_lost(self):
        self.drive = tiny_drive.make_drive(self.root / "longer", frames=10)
        self.edit_lines("oxts", line_5="")
        self.lose("oxts", 5, ".txt")
        self.assertIn("1 of 10 GPS/IMU records are missing", self.convert())
        self.assertEqual(self.stamps("/odometry"), [100 * i for i in range(10) if i != 5])
        self.assertEqual(len(self.messages("/scan")), 10)
        self.assertAlmostEqual(self.messages("/ground_truth/pose")[-1].pose.pose.position.x, 9.0)

    def test_too_many_motion_records_lost(self):
        self.lose("oxts", 1, ".txt")
        self.lose("oxts", 2, ".txt")
        self.assertIn("2 records with stamp and file, expected 4", self.convert(code=1))

    def test_stamps_without_fraction(self):
        for kind in ("oxts", "velodyne_points", "image_00", "image_01"):
            lines = {f"line_{i}": f"2011-09-26 13:04:{32 + i}" for i in range(tiny_drive.FRAMES)}
            self.edit_lines(kind, **lines)
        self.convert("--images")
        self.assertEqual(self.stamps("/odometry"), [0, 1000, 2000, 3000])

    def test_stamps_of_the_turn_alone(self):
        """The Velodyne's timestamps_start.txt and timestamps_end.txt, half a turn about its own."""
        folder = self.drive / "velodyne_points"
        for name, offset in (("start", -50), ("end", 50)):
            stamps = (1000 + 100 * frame + offset for frame in range(tiny_drive.FRAMES))
            lines = (f"2011-09-26 13:04:{31 + s // 1000}.{s % 1000:03d}\n" for s in stamps)
            (folder / f"timestamps_{name}.txt").write_text("".join(lines))
        (folder / "timestamps.txt").unlink()
        self.convert()
        self.assertEqual(self.stamps("/ground_truth/objects"), [0, 100, 200, 300])

    def test_without_cameras(self):
        shutil.rmtree(self.drive / "image_00")
        self.convert()
        (self.drive / "image_02").mkdir()
        said = self.convert("--images", code=1)
        self.assertIn("image_00: missing, expected the gray cameras", said)
        self.assertIn("image_01, image_02", said)

    def test_without_tracklets(self):
        (self.drive / "tracklet_labels.xml").unlink()
        self.convert()
        self.assertEqual(self.messages("/ground_truth/objects"), [])
        self.assertEqual(len(self.messages("/ground_truth/pose")), tiny_drive.FRAMES)

    def test_every_type_of_tracklet(self):
        path = self.drive / "tracklet_labels.xml"
        text = path.read_text()
        for label, expected in TYPES.items():
            path.write_text(text.replace(">Van<", f">{label}<"))
            self.convert()
            found = self.messages("/ground_truth/objects")[0].objects[0]
            self.assertEqual((found.label, found.classification), (label, expected))

    def test_every_type_of_tracking_label(self):
        labels = self.root / "0000.txt"
        names = [name for name in TYPES if " " not in name]
        lines = [LABEL.format(frame=0, number=i, label=name) for i, name in enumerate(names)]
        lines.append("0 -1 DontCare -1 -1 -10 1 2 3 4 -1000 -1000 -1000 -10 -1 -1 -1\n")
        labels.write_text("".join(lines))
        self.convert("--labels", str(labels))
        objects = self.messages("/ground_truth/objects")[0].objects
        found = {item.label: item.classification for item in objects}
        self.assertEqual(found, {name: TYPES[name] for name in names})


class PositionsTest(Conversion):
    def test_calibration_in_the_drive(self):
        for path in self.drive.parent.glob("calib_*.txt"):
            path.rename(self.drive / path.name)
        self.convert()

    def test_calibration_of_the_day_beside_the_drive(self):
        drive = self.root / self.drive.name
        self.drive.rename(drive)
        self.drive = drive
        self.convert()

    def test_calibration_elsewhere(self):
        folder = self.root / "calibration"
        folder.mkdir()
        for path in self.drive.parent.glob("calib_*.txt"):
            path.rename(folder / path.name)
        said = self.convert(code=1)
        self.assertIn("2011_09_26_calib.zip", said)
        self.assertIn("--calibration FOLDER", said)
        self.convert("--calibration", str(folder))

    def test_folder_of_the_day(self):
        drive, self.drive = self.drive, self.drive.parent
        self.assertIn(f"it holds {drive}", self.convert(code=1))

    def test_zip(self):
        self.drive = self.root / "2011_09_26_drive_0001_sync.zip"
        self.drive.write_bytes(b"PK\3\4")
        self.assertIn(f"'unzip {self.drive}' makes it", self.convert(code=1))


class Unsynchronized(Conversion):
    def make(self):
        return tiny_drive.make_extract(self.root)

    def test_every_sensor_at_its_own_rate(self):
        self.assertIn("an unsynchronized drive", self.convert("--points"))
        self.assertEqual(len(self.messages("/scan")), tiny_drive.FRAMES)
        self.assertEqual(self.stamps("/odometry"), list(range(0, 301, 10)))
        self.assertAlmostEqual(self.messages("/ground_truth/pose")[-1].pose.pose.position.x, 3.0)
        self.assertAlmostEqual(self.messages("/scan")[1].ranges[40], 10.0, places=4)
        self.assertEqual(self.messages("/ground_truth/objects"), [])

    def test_part_of_it(self):
        self.convert("--start", "1", "--end", "3", "--images")
        self.assertEqual(self.stamps("/points"), [])
        self.assertEqual(self.stamps("/odometry"), list(range(50, 251, 10)))
        self.assertEqual(self.stamps("/stereo/left/image_rect"), [100, 200])

    def test_scan_lost(self):
        self.edit_lines("velodyne_points", line_1="")
        self.lose("velodyne_points", 1, ".txt")
        self.assertIn("0000000001.txt is missing", self.convert(code=1))
        self.convert("--allow-missing-scans")
        self.assertEqual(len(self.messages("/scan")), tiny_drive.FRAMES - 1)

    def test_motion_stamped_out_of_order(self):
        self.edit_lines("oxts", line_7="2011-09-26 13:04:32.050000000")
        self.convert()
        self.assertEqual(self.stamps("/odometry"), [t for t in range(0, 301, 10) if t != 70])

    def test_images_are_rectified(self):
        """The raw image's dark corner is removed: it lies one pixel outside the rectified image."""
        self.convert("--images")
        image = self.messages("/stereo/right/image_rect")[0]
        self.assertEqual((image.width, image.height), (tiny_drive.WIDTH, tiny_drive.HEIGHT))
        self.assertEqual(set(np.frombuffer(image.data, np.uint8)), {30})
        info = self.messages("/stereo/right/camera_info")[0]
        self.assertEqual((info.width, info.P[3]), (8, -tiny_drive.FOCAL * tiny_drive.BASELINE))

    def test_image_of_one_camera_lost(self):
        self.lose("image_01", 2, ".png")
        self.convert("--images")
        self.assertEqual(self.stamps("/stereo/left/image_rect"), [0, 100, 300])

    def test_labels_are_of_the_other_form(self):
        labels = self.root / "0000.txt"
        labels.write_text(LABEL.format(frame=0, number=0, label="Car"))
        self.assertIn("expected a synchronized drive", self.convert("--labels", str(labels), code=1))

    def test_broken_clouds(self):
        path = self.drive / "velodyne_points" / "data" / "0000000000.txt"
        for text, expected in (
            ("1 2 3\n", "3 numbers, expected a multiple of 4"),
            ("", "0 numbers"),
            ("1 2 3 x\n", "expected lines of x, y, z, reflectance"),
        ):
            path.write_text(text)
            said = self.convert(code=1)
            self.assertIn(str(path), said)
            self.assertIn(expected, said)


if __name__ == "__main__":
    unittest.main()
