#!/usr/bin/python3
"""Scores a run on a drive with truth, and prints a table.

usage: score_drive.py TRUTH.bag OUTPUT.bag [--gate M] [--label-view DEG]

TRUTH.bag holds /ground_truth/pose, /ground_truth/objects and /odometry, OUTPUT.bag /pose and
/tracks. The map of the run is laid on the truth's at its first pose. A track counts for the true
object whose box is nearest to its centre, one to one, within the gate. Tracks on no labelled object
are counted only where KITTI labels: in the camera's view. Not everything there is labelled, so
their number is an upper bound.
"""

import argparse
import math
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import rosbag

from datmo_fusion.msg import Object
from datmo_tools import transforms
from drive_score import (
    PosePath,
    TrackingScore,
    TrackState,
    TrueBox,
    alignment,
    end_point_error,
    score_tracking,
)

DEFAULT_GATE = 2.5  # m from the track's centre to the box
DEFAULT_LABEL_VIEW = 40.0  # degrees to either side of straight ahead: what KITTI's cameras see
LABEL_RANGE = 50.0  # m, the emulated scanner's
MAX_SCAN_TO_TRUTH = 50_000_000  # ns: half a turn of the Velodyne


class DriveScore(NamedTuple):
    """What is asserted and printed."""

    distance: float  # m, true
    pose_error: float  # m, at the end
    odometry_error: float  # m, at the end
    tracking: TrackingScore


def score(truth_bag, output_bag, gate=DEFAULT_GATE, label_view=DEFAULT_LABEL_VIEW):
    """DriveScore of two bags (paths)."""
    recorded = _read(truth_bag, ("/ground_truth/pose", "/ground_truth/objects", "/odometry"))
    computed = _read(output_bag, ("/pose", "/tracks"))
    truth = _path(recorded["/ground_truth/pose"])
    estimate = _path(computed["/pose"])
    map_in_truth = alignment(estimate, truth)
    tracks = {
        m.header.stamp.to_nsec(): [_track(item, map_in_truth) for item in m.tracks]
        for m in computed["/tracks"]
    }
    boxes = {}
    for message in recorded["/ground_truth/objects"]:
        stamp = message.header.stamp.to_nsec()
        scan = _near(stamp, tracks)
        boxes[scan] = [_box(item, (scan - stamp) * 1e-9) for item in message.objects]

    def in_view(stamp, position):
        seen = transforms.relative(truth.at(stamp), [*position, 0.0])
        return (
            abs(math.atan2(seen[1], seen[0])) <= math.radians(label_view)
            and math.hypot(seen[0], seen[1]) <= LABEL_RANGE
        )

    return DriveScore(
        truth.length(),
        end_point_error(estimate, truth),
        end_point_error(_path(recorded["/odometry"]), truth),
        score_tracking(boxes, tracks, in_view, gate),
    )


def table(result):
    """The score as text."""
    share = 100.0 / result.distance
    lines = [
        f"distance {result.distance:.1f} m",
        f"end point error of the pose      {result.pose_error:6.2f} m "
        f"{result.pose_error * share:5.1f} %",
        f"end point error of the odometry  {result.odometry_error:6.2f} m "
        f"{result.odometry_error * share:5.1f} %",
        "",
        "   id label          frames   moving  tracked       share  reported moving  ids x frames",
    ]
    for item in result.tracking.objects:
        ids = " ".join(f"{number}x{frames}" for number, frames in item.track_frames.items())
        lines.append(
            f"{item.number:5d} {item.label:15s}{item.frames:6d}{item.moving_frames:9d}"
            f"{item.tracked_frames:9d}{100.0 * item.tracked_share:10.1f} %"
            f"{100.0 * item.reported_moving_share:15.1f} %  {ids}"
        )
    false_frames = result.tracking.false_track_frames
    lines.append(
        f"tracks on no labelled object, in the labels' view: {len(false_frames)}, "
        f"{sum(false_frames.values())} times in {result.tracking.frames} frames"
    )
    return "\n".join(lines)


def _read(path, topics):
    """Dictionary topic -> its messages."""
    messages = {topic: [] for topic in topics}
    with rosbag.Bag(str(path)) as bag:
        for topic, message, _ in bag.read_messages(list(topics)):
            messages[topic].append(message)
    missing = [topic for topic in topics if not messages[topic]]
    if missing:
        raise ValueError(f"{path}: no messages on {', '.join(missing)}, expected some")
    return messages


def _path(messages):
    """PosePath of Odometry or PoseWithCovarianceStamped messages."""
    poses = [
        [m.pose.pose.position.x, m.pose.pose.position.y, _yaw(m.pose.pose.orientation)]
        for m in messages
    ]
    return PosePath([m.header.stamp.to_nsec() for m in messages], poses)


def _yaw(quaternion):
    return 2.0 * math.atan2(quaternion.z, quaternion.w)


def _near(stamp, stamps):
    """The nearest of `stamps` within half a scan; `stamp` itself where there is none."""
    nearest = min(stamps, key=lambda other: abs(other - stamp))
    return nearest if abs(nearest - stamp) <= MAX_SCAN_TO_TRUTH else stamp


def _box(item, seconds):
    """TrueBox of a TrueObject `seconds` after its stamp."""
    position, velocity = item.pose.position, item.velocity
    pose = np.array(
        [
            position.x + velocity.x * seconds,
            position.y + velocity.y * seconds,
            _yaw(item.pose.orientation),
        ]
    )
    is_vehicle = item.classification == Object.CLASS_VEHICLE
    return TrueBox(item.id, item.label, is_vehicle, item.moving, pose, item.size.x, item.size.y)


def _track(item, map_in_truth):
    position = transforms.compose(map_in_truth, [item.pose.position.x, item.pose.position.y, 0.0])[
        :2
    ]
    return TrackState(item.id, position, item.moving)


def main():
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("truth", type=Path, metavar="TRUTH.bag")
    parser.add_argument("output", type=Path, metavar="OUTPUT.bag")
    parser.add_argument("--gate", type=float, default=DEFAULT_GATE, metavar="M")
    parser.add_argument("--label-view", type=float, default=DEFAULT_LABEL_VIEW, metavar="DEG")
    values = parser.parse_args()
    try:
        print(table(score(values.truth, values.output, values.gate, values.label_view)))
    except (OSError, ValueError, rosbag.ROSBagException) as error:
        print(f"score_drive: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
