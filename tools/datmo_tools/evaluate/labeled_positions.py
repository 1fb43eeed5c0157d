# SPDX-License-Identifier: BSD-3-Clause
"""Reads positions labeled in a recording, and transforms them to the map of a run."""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.bag_input import opened
from datmo_tools.check_bag.motion_signal import planar_mount
from datmo_tools.check_bag.transform_table import TransformTable, bare
from datmo_tools.errors import InputError
from datmo_tools.pose_path import read_path
from datmo_tools.stamps import NANOSECONDS

TRANSFORM_TOPICS = "/tf", "/tf_static"
MAX_AGE = NANOSECONDS  # ns, from a scan to a label made on it


class LabeledPosition(NamedTuple):
    """One labeled position."""

    stamp: int  # ns, of the scan that it was labeled in
    id: int
    position: np.ndarray  # x, y, m, in the map of the run


class LabelOptions(NamedTuple):
    """Topics and frames of the labels in the recording."""

    topic: str
    scan: str = "/scan"
    frame: str = ""  # of positions without header; "": that of the scans
    base: str = "base_link"


def read_labels(recording, run, options):
    """Returns a list of LabeledPosition by increasing stamp.

    recording: bag (Path) with messages of any type with `pose` and `id` on options.topic; run:
    result of run_bag on it (Path), whose /pose transforms them to its map. A label without a header
    belongs to the last scan recorded before it. Raises InputError.
    """
    labels, scans, tree = _read(recording, options)
    if not labels:
        raise InputError(f"{recording}: nothing on {options.topic}, expected labeled positions")
    if not scans:
        raise InputError(f"{recording}: nothing on {options.scan}, expected the scans")
    path = read_path(run, "/pose")
    frame = options.frame or scans[0][2]
    moments = [_moment(label, recorded, scans, frame) for label, recorded in labels]
    return [
        LabeledPosition(stamp, label.id, _in_map(label, label_frame, stamp, tree, path, options))
        for (label, _), (stamp, label_frame) in zip(labels, moments)
        if stamp is not None
    ]


def _read(recording, options):
    labels, scans, tree = [], [], TransformTable()
    topics = [options.topic, options.scan, *TRANSFORM_TOPICS]
    with opened(recording) as bag:
        for topic, message, recorded in bag.read_messages(topics):
            if topic == options.topic:
                labels.append((_checked(recording, topic, message), recorded.to_nsec()))
            elif topic == options.scan:
                header = message.header
                scans.append((recorded.to_nsec(), header.stamp.to_nsec(), header.frame_id))
            else:
                tree.add(message, topic == TRANSFORM_TOPICS[1], 0)
    return labels, scans, tree


def _checked(recording, topic, message):
    pose = getattr(message, "pose", None)
    pose = getattr(pose, "pose", pose)
    if not hasattr(pose, "position") or not hasattr(message, "id"):
        raise InputError(f"{recording}: {topic} has no pose and id, expected one of an object each")
    if not np.all(np.isfinite([pose.position.x, pose.position.y])):
        raise InputError(
            f"{recording}: {topic}: id {message.id} at {pose.position.x:g}, {pose.position.y:g}, "
            "expected finite numbers"
        )
    return message


def _moment(label, recorded, scans, frame):
    """Returns the stamp of a label's scan, and the label's frame; None without scan."""
    header = getattr(label, "header", None)
    if header is not None and header.stamp.to_nsec() > 0:
        return header.stamp.to_nsec(), header.frame_id or frame
    index = int(np.searchsorted([scan[0] for scan in scans], recorded, side="right")) - 1
    if index < 0 or recorded - scans[index][0] > MAX_AGE:
        return None, frame
    return scans[index][1], frame


def _in_map(label, frame, stamp, tree, path, options):
    pose = getattr(label.pose, "pose", label.pose)
    mount = tree.between(options.base, bare(frame))
    if mount is None:
        raise InputError(
            f"no transform {options.base} -> {bare(frame)} in the recording, expected it in /tf or "
            "/tf_static (--base and --frame select other frames)"
        )
    planar, _, _ = planar_mount(mount)
    point = np.array([pose.position.x, pose.position.y, 0.0])
    in_base = transforms.compose(planar, point)
    return transforms.compose(path.at(stamp), in_base)[:2]
