#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/check_layers on small made-up trees: a good one passes, each violation is found."""

import subprocess
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "check_layers"

GOOD = {
    "include/datmo_fusion/common/pose.h": "#include <Eigen/Core>\n#include <vector>\n",
    "include/datmo_fusion/grid/map.h": '#include "datmo_fusion/common/pose.h"\n',
    "src/grid/map.cpp": '#include "datmo_fusion/grid/map.h"\n#include <cmath>\n',
    "src/slam/slam.cpp": '#include "datmo_fusion/grid/map.h"\n#include "private.h"\n',
    "src/slam/private.h": "#include <vector>\n",
    "src/ros/convert.cpp": '#include <ros/ros.h>\n#include "datmo_fusion/Object.h"\n'
                           '#include "datmo_fusion/grid/map.h"\n',
    "src/nodelets/host.cpp": "#include <nodelet/nodelet.h>\n#include \"datmo_fusion/ros/convert.h\"\n",
    "tools/run/main.cpp": '#include <rosbag/bag.h>\n#include "datmo_fusion/ros/convert.h"\n',
    "test/unit/grid/test_map.cpp": '#include <gtest/gtest.h>\n#include "datmo_fusion/grid/map.h"\n',
}


class CheckLayers(unittest.TestCase):
    def run_on(self, extra):
        """Returns exit code and output for the valid tree with `extra` files {path:
        text} added to it."""
        with tempfile.TemporaryDirectory() as folder:
            for path, text in {**GOOD, **extra}.items():
                file = Path(folder, path)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text)
            done = subprocess.run([str(SCRIPT), folder], stdout=subprocess.PIPE, check=False)
            return done.returncode, done.stdout.decode()

    def expect_violation(self, path, text, message):
        code, output = self.run_on({path: text})
        self.assertEqual(code, 1, output)
        self.assertIn("check_layers: 1 violations", output)
        self.assertIn(message, output)
        return output

    def test_good_tree_passes(self):
        code, output = self.run_on({})
        self.assertEqual(code, 0, output)
        self.assertIn("check_layers: 0 violations", output)

    def test_ros_header_in_the_core(self):
        output = self.expect_violation(
            "src/slam/bad.cpp", "\n#include <ros/time.h>\n", "slam/ includes ros/time.h")
        self.assertIn("src/slam/bad.cpp:2:", output)

    def test_private_headers_stay_in_their_room_and_keep_its_rules(self):
        self.expect_violation(
            "src/grid/bad.cpp", '#include "private.h"\n', "grid/ includes private.h")
        self.expect_violation(
            "src/slam/private.h", "#include <ros/time.h>\n", "slam/ includes ros/time.h")

    def test_generated_message_in_the_core(self):
        self.expect_violation("include/datmo_fusion/tracking/bad.h",
                              '#include "datmo_fusion/TrackArray.h"\n',
                              "tracking/ includes datmo_fusion/TrackArray.h")

    def test_message_of_another_package_in_the_core(self):
        self.expect_violation("src/common/bad.cpp", "#include <sensor_msgs/LaserScan.h>\n",
                              "common/ includes sensor_msgs/LaserScan.h")

    def test_include_of_a_higher_room(self):
        self.expect_violation("include/datmo_fusion/grid/bad.h",
                              '#include "datmo_fusion/slam/slam.h"\n', "slam/ is a higher room")

    def test_core_includes_the_ros_room(self):
        self.expect_violation("src/tracking/bad.cpp", '#include "datmo_fusion/ros/convert.h"\n',
                              "ros/ is a higher room")

    def test_nothing_includes_nodelets(self):
        self.expect_violation("tools/run/bad.cpp", '#include "datmo_fusion/nodelets/host.h"\n',
                              "nothing includes nodelets/")

    def test_nothing_includes_tools(self):
        self.expect_violation("src/ros/bad.cpp", '#include "run/main.cpp"\n',
                              "nothing includes tools/")

    def test_unknown_room(self):
        self.expect_violation("src/attic/bad.cpp", "#include <vector>\n",
                              "the room attic/ is not known")

    def test_ros_in_a_unit_test_of_the_core(self):
        self.expect_violation("test/unit/grid/test_bad.cpp", "#include <ros/ros.h>\n",
                              "a test of the core includes ros/ros.h")

    def test_circle_of_rooms_on_one_level(self):
        code, output = self.run_on({
            "src/slam/a.cpp": '#include "datmo_fusion/detection/b.h"\n',
            "src/detection/b.cpp": '#include "datmo_fusion/slam/a.h"\n',
        })
        self.assertEqual(code, 1, output)
        self.assertIn("cycle: detection -> slam -> detection", output)

    def test_folder_without_sources_is_named(self):
        done = subprocess.run([str(SCRIPT), "/nonexistent"], stderr=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("/nonexistent", done.stderr.decode())


if __name__ == "__main__":
    unittest.main()
