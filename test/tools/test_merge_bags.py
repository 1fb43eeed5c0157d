#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Parts of a recording become one bag: order, latched topics, errors."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import rosbag
from datmo_tools.bag_file import whole_bag
from datmo_tools.convert.merge_bags import main
from std_msgs.msg import String


class Merge(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name)
        self.parts = [self.root / f"drive_{number}.bag" for number in range(2)]
        self.bag = self.root / "drive.bag"

    def write(self, part, *messages):
        """messages: (topic, s, text)."""
        with whole_bag(part, "test") as bag:
            for topic, seconds, text in messages:
                write = bag.write_latched if topic == "/static" else bag.write
                write(topic, seconds * 10**9, String(text))

    def merge(self, *parts, code=0):
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            self.assertEqual(main([str(path) for path in (*parts, self.bag)]), code)
        return errors.getvalue()

    def read(self):
        with rosbag.Bag(str(self.bag)) as bag:
            return [(topic, int(time.to_sec()), message.data)
                    for topic, message, time in bag.read_messages()]  # fmt: skip

    def test_parts_by_time_whatever_their_order(self):
        first = [("/static", 1, "mount"), ("/text", 2, "a")]
        second = [("/text", 3, "b"), ("/text", 4, "c")]
        self.write(self.parts[0], *first)
        self.write(self.parts[1], *second)
        self.merge(*reversed(self.parts))
        self.assertEqual(self.read(), first + second)

    def test_parts_at_the_same_time(self):
        self.write(self.parts[0], ("/left", 1, "a"), ("/left", 3, "c"))
        self.write(self.parts[1], ("/right", 2, "b"))
        self.merge(*self.parts)
        self.assertEqual([text for _, _, text in self.read()], ["a", "b", "c"])

    def test_latched_stays_latched(self):
        self.write(self.parts[0], ("/static", 1, "mount"), ("/text", 2, "a"))
        self.merge(self.parts[0])
        with rosbag.Bag(str(self.bag)) as bag:
            headers = {m.topic: m.connection_header
                       for m in bag.read_messages(return_connection_header=True)}  # fmt: skip
        self.assertEqual(headers["/static"]["latching"], b"1")
        self.assertNotEqual(headers["/text"].get("latching"), b"1")

    def test_bad_parts(self):
        self.write(self.parts[0], ("/text", 2, "a"))
        self.assertIn("drive_1.bag: no such file", self.merge(*self.parts, code=1))
        self.assertIn("given twice", self.merge(self.parts[0], self.parts[0], code=1))
        self.assertIn("must not be an input", self.merge(self.parts[0], self.bag, code=1))
        self.assertFalse(self.bag.exists())


if __name__ == "__main__":
    unittest.main()
