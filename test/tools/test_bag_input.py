#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Unreadable bags: each kind is named, with what to do about it."""

import bz2
import os
import struct
import tempfile
import unittest
import zipfile
from pathlib import Path

import rosbag
from datmo_tools.bag_input import fault_of, opened
from datmo_tools.errors import InputError
from rospy import Time
from std_msgs.msg import String

MESSAGES = 200
INDEX_POSITION = struct.Struct("<Q")


class BagInput(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        self.bag = self.root / "drive.bag"

    def write(self, compression="none", messages=MESSAGES):
        with rosbag.Bag(str(self.bag), "w", compression=compression, chunk_threshold=1024) as bag:
            for number in range(messages):
                bag.write("/text", String(f"number {number}"), Time(1 + number))

    def read(self, path=None):
        with opened(path or self.bag) as bag:
            return [message.data for _, message, _ in bag.read_messages()]

    def assert_refused(self, *texts, path=None):
        with self.assertRaises(InputError) as context:
            self.read(path)
        for text in (str(path or self.bag), *texts):
            self.assertIn(text, str(context.exception))


class Readable(BagInput):
    def test_every_compression(self):
        for compression in ("none", "bz2", "lz4"):
            self.write(compression)
            self.assertEqual(len(self.read()), MESSAGES)
            self.assertEqual(self.read(str(self.bag))[-1], f"number {MESSAGES - 1}")

    def test_no_fault(self):
        self.write()
        self.assertIsNone(fault_of(self.bag))


class Unreadable(BagInput):
    def test_not_there(self):
        self.assert_refused("no such file")

    def test_no_bag(self):
        self.bag.write_text("not a bag")
        self.assert_refused("is not a bag, expected a file that begins with #ROSBAG")

    def test_other_format(self):
        """rosbag takes the third for 2.0."""
        for version in ("V1.2", "V3.0", "V2.00", "V2.0"):
            self.bag.write_text(f"#ROSBAG {version}")
            self.assert_refused("is not of bag format 2.0, expected '#ROSBAG V2.0' as its first line")

    def test_empty(self):
        self.bag.write_bytes(b"")
        self.assert_refused("is empty (0 bytes)")

    def test_without_messages(self):
        self.write(messages=0)
        self.assert_refused("holds no message")

    def test_pipe(self):
        os.mkfifo(self.bag)
        self.assert_refused("is a pipe or a device")

    @unittest.skipIf(os.geteuid() == 0, "root may read every file")
    def test_permission(self):
        self.write()
        self.bag.chmod(0)
        self.assert_refused("no permission to read it", "chmod u+r")

    def test_packed(self):
        with zipfile.ZipFile(self.bag, "w") as archive:
            archive.writestr("drive.bag", "#ROSBAG V2.0\n")
        self.assert_refused("is compressed", f"'unzip {self.bag}'")
        self.bag.write_bytes(bz2.compress(b"#ROSBAG V2.0\n"))
        self.assert_refused("is compressed", f"'bunzip2 {self.bag}'")

    def test_cut(self):
        self.write()
        size = self.bag.stat().st_size
        for share in (0.01, 0.3, 0.9, 0.999):
            self.write()
            os.truncate(self.bag, int(share * size))
            self.assert_refused("has no index", f"'rosbag reindex {self.bag}'")

    def test_not_closed(self):
        """As left by a recorder that was killed: the position of the index is 0."""
        self.write()
        content = self.bag.read_bytes()
        position = content.index(b"index_pos=") + len(b"index_pos=")
        nothing = INDEX_POSITION.pack(0)
        self.bag.write_bytes(content[:position] + nothing + content[position + len(nothing) :])
        self.assert_refused("has no index", "or is still being written")

    def test_damaged_record(self):
        """A field that is not UTF-8, and a message of a connection that there is not."""
        self.write()
        content = self.bag.read_bytes()
        self.bag.write_bytes(content.replace(b"time=", b"t\xe8me=", 1))
        self.assert_refused("cannot be read as a bag (UnicodeDecodeError in a record: ")
        record = content.index(b"op=\x02")
        self.bag.write_bytes(content[:record] + content[record:].replace(b"conn=\0", b"conn=\x81", 1))
        self.assert_refused("cannot be read as a bag (KeyError in a record: 129)")

    def test_errors_of_the_caller_are_not_the_bags(self):
        self.write()
        with self.assertRaises(KeyError), opened(self.bag):
            {}["a key"]  # pylint: disable=expression-not-assigned

    def test_damaged_chunk(self):
        for compression in ("bz2", "lz4"):
            self.write(compression)
            content = bytearray(self.bag.read_bytes())
            chunk = content.index(b"BZh" if compression == "bz2" else b"\x04\x22\x4d\x18")
            content[chunk + 20 : chunk + 120] = b"\xff" * 100
            self.bag.write_bytes(content)
            self.assert_refused("cannot be read as a bag")


class OfRos2(BagInput):
    def test_database(self):
        self.bag.write_bytes(b"SQLite format 3\0" + bytes(100))
        self.assert_refused("ROS 2", f"'rosbags-convert --src {self.bag} --dst")

    def test_mcap(self):
        self.bag.write_bytes(b"\x89MCAP0\r\n" + bytes(100))
        self.assert_refused("ROS 2", "rosbags-convert")

    def test_folder(self):
        for name in ("metadata.yaml", "drive_0.db3", "drive_0.mcap"):
            folder = self.root / f"with_{name}"
            folder.mkdir()
            (folder / name).write_text("")
            self.assert_refused("ROS 2", f"--src {folder} ", path=folder)


class Folder(BagInput):
    def test_without_bags(self):
        self.assert_refused("is a folder, expected a bag", path=self.root)

    def test_bags_are_named(self):
        for number in range(5):
            (self.root / f"drive_{number}.bag").write_text("")
        self.assert_refused("it holds drive_0.bag, drive_1.bag, drive_2.bag, ...", path=self.root)


if __name__ == "__main__":
    unittest.main()
