# SPDX-License-Identifier: BSD-3-Clause
"""evaluate labels."""

import tempfile
from pathlib import Path

import numpy as np
from geometry_msgs.msg import Point, Pose, Quaternion

from datmo_fusion.msg import Track, TrackArray, TrueObject, TrueObjectArray
from datmo_tools import bag_messages, command_line
from datmo_tools.bag_file import whole_bag
from datmo_tools.errors import InputError
from datmo_tools.evaluate.labeled_positions import LabelOptions, read_labels
from datmo_tools.evaluate.report import Section
from datmo_tools.evaluate.score_run import matches
from datmo_tools.evaluate.track_lists import TRACKS, read_track_lists
from datmo_tools.stamps import NANOSECONDS
from datmo_tools.text_table import rounded

DESCRIPTION = """\
Scores the tracks of a result of run_bag against positions that were labeled in the recording, as
messages of any type with `pose` and `id`: how many have a track within --gate, matched one to one,
and how often a labeled id switches to another track. A label may have a header; without one it
belongs to the last scan recorded before it, in that scan's frame.

Unlabeled objects are not scored: if only some people are labeled, false tracks are not detected."""

GATE = 0.5  # m
EVERYWHERE = 500.0  # m
TRACK_TOLERANCE = 0.05  # s, from the stamp of a label to that of the nearest list of tracks


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("run", type=Path, metavar="RUN.bag", help="bag of run_bag, with /tracks and /pose")
    add("recording", type=Path, metavar="RECORDING.bag", help="the bag that it was made from, with the labels")
    add("--labels", required=True, metavar="TOPIC", help="topic of the labels")
    add("--scan", default="/scan", metavar="TOPIC", help="of the scans (default %(default)s)")
    add("--base", default="base_link", metavar="FRAME", help="of the vehicle (default %(default)s)")
    add("--frame", default="", help="of labels without a header (default: that of the scans)")
    command_line.add_number(parser, "--gate", GATE, "M", "largest distance of a match, m")


def evaluate(values):
    """Returns the score and its sections. Raises InputError."""
    options = LabelOptions(values.labels, values.scan, values.frame, values.base)
    result = score(values.run, values.recording, options, values.gate)
    return result, sections(result)


def score(run, recording, options, gate=GATE):
    """Returns the score as a dictionary that JSON can hold. Raises InputError."""
    labels = read_labels(recording, run, options)
    if not labels:
        raise InputError(f"{recording}: no label of {options.topic} is of a scan, expected some")
    lists = read_track_lists(run, [TRACKS])[TRACKS]
    # Of any type in the recording, but a number from 0 on in score_run's bags.
    ids = sorted({label.id for label in labels})
    labels = [label._replace(id=ids.index(label.id)) for label in labels]
    found, switches, distances = {name: [] for name in ids}, [], []
    for stamp, frame in _matched(labels, lists, gate).items():
        distances += frame.distances.values()
        for number in frame.required:
            found[ids[number]].append(number in frame.objects.values())
        switches += [
            {"stamp_s": stamp / NANOSECONDS, "id": ids[number], "from": last, "to": present}
            for number, (last, present) in frame.switches.items()
        ]
    return _result(len(labels), found, switches, distances, gate)


def _matched(labels, lists, gate):
    """Returns a dictionary stamp (ns) -> FrameMatches of labels and the nearest tracks."""
    stamps = np.array([item.stamp for item in lists])
    options = {"align": "none", "moving_tracks_only": False, "truth/visible_to": "none",
               "truth/min_time_seen": 0.0, "region/range": EVERYWHERE, "matching/gate": gate,
               "matching/distance": "to_center"}  # fmt: skip
    with tempfile.TemporaryDirectory(prefix="labels_") as folder:
        laid_together = Path(folder) / "labels.bag"
        with whole_bag(laid_together, "evaluate") as bag:
            for stamp in sorted({label.stamp for label in labels}):
                nearest = lists[int(np.argmin(np.abs(stamps - stamp)))]
                is_near = abs(nearest.stamp - stamp) <= TRACK_TOLERANCE * NANOSECONDS
                tracks = nearest.tracks if is_near else []
                there = [label for label in labels if label.stamp == stamp]
                for topic, message in _messages(stamp, tracks, there).items():
                    bag.write(topic, stamp, message)
        return matches(laid_together, None, options)


def _messages(stamp, tracks, labels):
    header = bag_messages.header(stamp, bag_messages.MAP)
    about = (*labels[0].position, 0.0)
    objects = [TrueObject(id=label.id, pose=_pose(label.position), moving=True) for label in labels]
    return {
        TRACKS: TrackArray(header=header, tracks=[
            Track(id=track.id, pose=_pose(track.pose)) for track in tracks]),
        "/ground_truth/objects": TrueObjectArray(header=header, objects=objects),
        "/ground_truth/pose": bag_messages.planar_odometry(
            stamp, bag_messages.MAP, bag_messages.BASE, about, 0.0, 0.0),
    }  # fmt: skip


def _pose(position):
    return Pose(Point(position[0], position[1], 0.0), Quaternion(0.0, 0.0, 0.0, 1.0))


def _result(count, found, switches, distances, gate):
    return {
        "positions": count,
        "found": len(distances),
        "found_share": len(distances) / count,
        "gate_m": gate,
        "median_distance_m": float(np.median(distances)) if distances else None,
        "id_switches": len(switches),
        "ids": len(found),
        "ids_never_found": sorted(name for name, hits in found.items() if not any(hits)),
        "by_id": {str(name): {"found": sum(hits), "positions": len(hits)}
                  for name, hits in sorted(found.items())},
        "switches": switches,
    }  # fmt: skip


def sections(result):
    """Returns a list of Section for a score."""
    median = result["median_distance_m"]
    return [Section(lines=[
        f"labeled positions with a track within {result['gate_m']:.2f} m: {result['found']} of "
        f"{result['positions']} ({100.0 * result['found_share']:.1f} %)",
        f"median distance: {rounded(median, 2)} m",
        f"id switches: {result['id_switches']} of {result['ids']} labeled ids; never found: "
        f"{len(result['ids_never_found'])}",
    ])]  # fmt: skip
