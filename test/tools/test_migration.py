#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""rosbag fix with our rule makes bags readable whose objects have no class_probabilities."""

import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

import rosbag
from datmo_tools.bag_input import check_type, opened
from datmo_tools.errors import InputError
from geometry_msgs.msg import Point32
from old_objects import OBJECT, ROOT, RULE, old_checksum, old_types
from rospy import Time

from datmo_fusion.msg import DroppedObjects, Object, ObjectArray, TrackArray

# Of Object.msg before the change, as in recordings of that time.
RECORDED_CHECKSUM = "f26bfbed5978d9b373bee3cb4bec48af"
FIX = "import rosbag; rosbag.rosbagmain()"


def filled(message):
    """An object of this class, with a value in each kind of field."""
    message.pose.position.x = 3.0
    message.position_covariance = [0.25, 0.0, 0.0, 0.5]
    message.classification, message.class_probability = Object.CLASS_CYCLIST, 0.75
    message.velocity.x = -2.0
    message.sensors = ["lidar", "stereo"]
    message.points = [Point32(1.0, 2.0, 0.0)]
    return message


class Migration(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.old, self.new = Path(folder.name) / "old.bag", Path(folder.name) / "new.bag"
        self.write_old()

    def write_old(self):
        lists, dropped = old_types(ObjectArray), old_types(DroppedObjects)
        objects = lists[ObjectArray._type](objects=[filled(lists[OBJECT]())])
        objects.header.stamp = Time(100)
        item = dropped["datmo_fusion/DroppedObject"](object=filled(dropped[OBJECT]()))
        with rosbag.Bag(str(self.old), "w") as bag:
            bag.write("/objects", objects, Time(100.5))
            bag.write("/objects/dropped", dropped[DroppedObjects._type](objects=[item]), Time(101))
            bag.write("/tracks", TrackArray(), Time(102))

    def fix(self):
        command = [sys.executable, "-c", FIX, "fix", "-n", self.old, self.new, RULE]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with opened(self.new) as bag:
            return {topic: (message, time) for topic, message, time in bag.read_messages()}

    def test_the_rule_converts_what_was_recorded(self):
        self.assertEqual(old_checksum(), RECORDED_CHECKSUM)

    def test_the_package_exports_the_rule(self):
        package = xml.etree.ElementTree.parse(ROOT / "package.xml")
        exported = package.find("export/rosbag").get("migration_rule_file")
        self.assertEqual(ROOT / exported, RULE)

    def test_an_old_bag_is_another_version(self):
        with opened(self.old) as bag:
            for topic, message, _ in bag.read_messages(["/objects"]):
                with self.assertRaisesRegex(InputError, "/objects is another version of .*rosbag"):
                    check_type(self.old, topic, message, ObjectArray)

    def test_objects_keep_all_they_had(self):
        messages = self.fix()
        objects, time = messages["/objects"]
        check_type(self.new, "/objects", objects, ObjectArray)
        self.assertEqual((objects.header.stamp, time), (Time(100), Time(100.5)))
        self.assertEqual(str(objects.objects), str([filled(Object())]))
        self.assertEqual(list(objects.objects[0].class_probabilities), [])
        dropped, _ = messages["/objects/dropped"]
        check_type(self.new, "/objects/dropped", dropped, DroppedObjects)
        self.assertEqual(str(dropped.objects[0].object), str(filled(Object())))

    def test_other_messages_are_copied(self):
        tracks, time = self.fix()["/tracks"]
        check_type(self.new, "/tracks", tracks, TrackArray)
        self.assertEqual(time, Time(102))


if __name__ == "__main__":
    unittest.main()
