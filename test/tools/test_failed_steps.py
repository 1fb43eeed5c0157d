#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Experiments whose programs fail: what they report, and that the others go on; with stand-ins for
the programs."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np
import rosbag
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from std_msgs.msg import String

from datmo_tools.errors import InputError
from datmo_tools.experiments import campaign, machines, pole_camera
from datmo_tools.experiments.campaign_page import page
from datmo_tools.programs import StepFailed

START = 100.0  # s
BOUNDS = """\
drive.bag:
  default: {largest_error_m: 0.5, largest_error_sigmas: 2.0, recovered_s: 0.5, mota_loss: null,
            added_false_positives: null, added_id_switches: null}
  scan frozen for 3 s: refused
silent scanner: {share_of_distance: 0.1, lost_ids: 1}
"""
# Its runs: without a fault; without poses; poses end with the fault; refused; ended.
RUN_BAG = """\
#!/bin/sh
here=$(dirname "$0")
echo >> "$here/runs"
case $(wc -l < "$here/runs") in
  2) cp "$here/none.bag" "$2" ;;
  3) cp "$here/short.bag" "$2" ;;
  4) echo "no scan" >&2; exit 1 ;;
  5) kill -9 $$ ;;
  *) cp "$here/whole.bag" "$2" ;;
esac
"""
FAULTS = ("scan silent for 3 s", "scan at half", "scan twice", "scan frozen", "odometry silent for 3 s")


def pose_at(seconds, kind):
    """Returns the pose of a drive at 5 m/s along x."""
    message = kind()
    message.header.stamp = rospy.Time.from_sec(START + seconds)
    pose = message.pose.pose
    pose.position.x, pose.orientation.w = 5.0 * seconds, 1.0
    message.pose.covariance = np.diag([0.01] * 6).ravel().tolist()
    return message


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def program(self, name, text):
        (self.folder / name).write_text(text)
        (self.folder / name).chmod(0o755)

    def bag(self, name, poses, *topics, kind=PoseWithCovarianceStamped):
        """Writes a bag with this many poses, ten a second."""
        with rosbag.Bag(str(self.folder / name), "w") as bag:
            bag.write("/other", String(), rospy.Time.from_sec(START))
            for i in range(poses):
                message = pose_at(0.1 * i, kind)
                for topic in topics:
                    bag.write(topic, message, message.header.stamp)

    def said(self, main, *words):
        """Returns exit code and standard error."""
        errors = io.StringIO()
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(errors):
            code = main([*map(str, words)])
        return code, errors.getvalue()


class Campaign(Folder):
    def setUp(self):
        super().setUp()
        self.bag("drive.bag", 200, campaign.TRUTH, "/odometry", kind=Odometry)
        self.bag("none.bag", 0)
        self.bag("short.bag", 79, "/pose", "/pose/local")
        self.bag("whole.bag", 200, "/pose", "/pose/local")
        self.program("run_bag", RUN_BAG)
        self.program("score_run", "#!/bin/sh\nexit 1\n")
        (self.folder / "config.yaml").touch()
        (self.folder / "bounds.yaml").write_text(BOUNDS)

    def test_a_failed_fault_is_a_row_and_counts_and_the_others_go_on(self):
        code, said = self.said(
            campaign.main, self.folder / "drive.bag", "--config", self.folder / "config.yaml", "--programs",
            self.folder, "--bounds", self.folder / "bounds.yaml", "--page", self.folder / "page.md",
            "--faults", *FAULTS)  # fmt: skip
        self.assertEqual(code, 1)
        rows = {line.split(" | ")[0][2:]: line for line in (self.folder / "page.md").read_text().splitlines()
                if line.startswith("| ")}  # fmt: skip
        self.assertIn("| none | 200 | 0.00 | 0.00 | 0.10 | 0.0 | 0.0 | - ", rows["none"])
        self.assertIn("| none: result.bag: 0 poses on /pose, expected two or more |", rows["scan silent for 3 s"])
        self.assertIn("| 79 | - | 0.00 | - | - | never | - ", rows["scan at half the rate for 5 s"])
        self.assertIn("| none: run_bag: ended by signal 9 |", rows["scan twice each for 5 s"])
        self.assertIn("| none: no scan |", rows["scan frozen for 3 s"])
        self.assertIn("| 200 | 0.00 | 0.00 |", rows["odometry silent for 3 s"])
        self.assertIn("drive.bag, scan silent for 3 s: result.bag: 0 poses", said)
        self.assertIn("drive.bag, scan at half the rate for 5 s: largest_error_m never known", said)
        self.assertIn("drive.bag, scan twice each for 5 s: run_bag: ended by signal 9", said)
        self.assertNotIn("scan frozen", said.partition("beyond their bounds")[2])

    def test_no_pose_in_the_time_of_the_truth(self):
        with self.assertRaisesRegex(InputError, "no pose on /pose in the time of the truth"):
            campaign.pose_errors(self.folder / "whole.bag", self.folder / "drive.bag", since=START + 1000.0)

    def test_a_silent_scanner_that_fails_is_a_result(self):
        self.program("run_bag", "#!/bin/sh\nexit 1\n")
        values = SimpleNamespace(programs=self.folder, config=self.folder / "config.yaml")
        messages = campaign._messages(self.folder / "drive.bag", campaign.INPUTS)
        found = campaign._silent_scanner(values, campaign.Played("drive.bag", messages, ()))
        self.assertEqual(len(found), len(campaign.LEVELS) * len(campaign.SILENT_FROM))
        self.assertEqual({each["error"] for each in found}, {"run_bag: failed without a message"})
        lines = campaign._beyond({"drives": [], "silent": found}, {})
        self.assertEqual(lines[0], "low, scan silent from 5 s: run_bag: failed without a message")

    def test_a_silent_scanner_that_fails_is_a_row(self):
        parts = dict.fromkeys(("mutated", "soak", "load", "outages"))
        drive = {"drive": "a.bag", "options": (), "of": 0, "runs": [{"fault": "none", "error": "ended", "refused": False}]}
        silent = [{"level": "low", "from_s": 5.0, "error": "result.bag: 0 poses"}]
        report = {"made": "", "beyond": [], "begin_s": 8.0, "drives": [drive], "silent": silent, **parts}
        self.assertIn("\n| low | 5 | none: result.bag: 0 poses | | | | | | | |\n", page(report))


class OneError(Folder):
    """Instead of a traceback."""

    def test_pole_camera(self):
        for name in ("simulate", "run_bag", "score_run"):
            self.program(name, '#!/bin/sh\necho "disk full" >&2\nexit 1\n')
        code, said = self.said(pole_camera.main, "scene.yaml", "--config", "c.yaml", "--programs", self.folder)
        self.assertEqual((code, said), (1, "pole_camera: seed 1: disk full\n"))

    def test_machines(self):
        failure = mock.Mock(side_effect=StepFailed("run_bag", "disk full"))
        with mock.patch.object(machines.lossy_network, "why_not", return_value=None), \
                mock.patch.object(machines, "fixture_drive"), mock.patch.object(machines, "measure", failure):
            code, said = self.said(machines.main, self.folder, "--programs", self.folder)
        self.assertEqual((code, said.splitlines()[-1]), (1, "machines: scanner: disk full"))


if __name__ == "__main__":
    unittest.main()
