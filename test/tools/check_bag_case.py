# SPDX-License-Identifier: BSD-3-Clause
"""check_bag on a recording that a test has changed, for its tests."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
import simulated_recording as simulated
import yaml

from datmo_tools import transforms
from datmo_tools.check_bag.main import main
from datmo_tools.check_bag.scan_matching import Outline


def of_topic(items, *topics):
    return [item for item in items if item.topic in topics]


def without(items, *topics):
    return [item for item in items if item.topic not in topics]


def shifted(items, topic, seconds):
    """Returns the recording with the headers of a topic delayed by this;
    record times are unchanged."""
    for item in of_topic(items, topic):
        stamp = item.message.header.stamp.to_nsec() + round(seconds * 1e9)
        item.message.header.stamp = simulated.to_ros_time(stamp)
    return items


def ranges(items, change):
    """Returns the recording with change(ranges as array) for each scan."""
    for item in of_topic(items, "/scan"):
        item.message.ranges = change(np.array(item.message.ranges)).tolist()
    return items


def each(items, topic, change):
    """Returns the recording with change(message) applied to each message of a topic."""
    for item in of_topic(items, topic):
        change(item.message)
    return items


def odometry_of(items, pose_at=simulated.pose_at, speed_scale=1.0, yaw_scale=1.0, delay=0.0):
    """Returns the recording with odometry made wrong by a scale or a delay, in poses and twists."""
    pose = np.array([0.0, 0.0, 0.0])
    before = None
    for item in of_topic(items, "/odometry"):
        time = 1e-9 * (item.message.header.stamp.to_nsec() - simulated.START) - delay
        true = pose_at(time)
        if before is not None:
            step = transforms.relative(before, true)
            arc = np.array([*(speed_scale * step[:2]), yaw_scale * step[2]])
            pose = transforms.compose(pose, arc)
        before = true
        speed, yaw_rate = simulated.motion_at(time)
        fields = simulated.odometry(0.0, pose, speed_scale * speed, yaw_scale * yaw_rate)
        item.message.pose, item.message.twist = fields.pose, fields.twist
    return items


def masked(values, first, last, value):
    values[first:last] = value
    return values


_match, _matches = Outline.match, {}


def match_once(outline, later, guesses):
    """Replaces Outline.match; most faults do not affect scans,
    and matching them takes half of the time."""
    key = outline.points.tobytes(), later.points.tobytes(), tuple(map(tuple, guesses))
    if key not in _matches:
        _matches[key] = _match(outline, later, guesses)
    return _matches[key]


class Tool(unittest.TestCase):
    def setUp(self):
        patch = mock.patch.object(Outline, "match", match_once)
        patch.start()
        self.addCleanup(patch.stop)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.bag, self.yaml = self.folder / "drive.bag", self.folder / "robot.yaml"

    def run_tool(self, items, code=None):
        """Returns findings (kind -> severity), the output, and the yaml's content."""
        simulated.write(self.bag, items)
        out, errors, file = io.StringIO(), io.StringIO(), self.folder / "findings.json"
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            done = main([str(self.bag), "--out", str(self.yaml), "--force", "--json", str(file)])
        if code is not None:
            self.assertEqual(done, code, out.getvalue() + errors.getvalue())
        findings = json.loads(file.read_text())["findings"]
        content = yaml.safe_load(self.yaml.read_text()) if self.yaml.exists() else None
        return {item["kind"]: item["severity"] for item in findings}, out.getvalue(), content

    def assert_finds(self, kind, items, severity="warning"):
        kinds, out, _ = self.run_tool(items, code=1 if severity == "error" else None)
        self.assertEqual(kinds.get(kind), severity, out)
        return kinds
