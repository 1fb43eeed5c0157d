"""Command line of score_labeled_positions."""

import argparse
from pathlib import Path

import numpy as np

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.labeled_positions import LabelOptions, read_labels
from datmo_tools.stamps import NANOSECONDS
from datmo_tools.track_lists import read_track_lists
from datmo_tools.track_matching import TrackMatcher

DESCRIPTION = """\
Scores the tracks of a result of run_bag against positions that were labeled in the recording, as
messages of any type with `pose` and `id`: how many have a track within --gate, each track for one
label and each label for one track, and how often a labeled id goes over to another track. A label
may have a header; without one it is of the scan recorded last before it, in that scan's frame.

What is not labeled is not judged: labels of some people say nothing of false tracks."""

TRACKS = "/tracks"
GATE = 0.5  # m
TRACK_TOLERANCE = 0.05  # s, from the stamp of a label to that of the nearest list of tracks


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run(
        "score_labeled_positions", lambda: _run(values), product="score"
    )


def _parser():
    parser = argparse.ArgumentParser(
        prog="score_labeled_positions",
        description=DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add("result", type=Path, help="result of run_bag, with /tracks and /pose")
    add("recording", type=Path, help="the bag that it was made from, with the labels")
    add("--labels", required=True, metavar="TOPIC", help="topic of the labels")
    add("--scan", default="/scan", metavar="TOPIC", help="of the scans (default %(default)s)")
    add("--base", default="base_link", metavar="FRAME", help="of the vehicle (default %(default)s)")
    add("--frame", default="", help="of labels without a header (default: that of the scans)")
    command_line.add_number(parser, "--gate", GATE, "M", "largest distance of a match, m")
    command_line.add_json(parser)
    return parser


def _run(values):
    options = LabelOptions(values.labels, values.scan, values.frame, values.base)
    result = score(values.result, values.recording, options, values.gate)
    print(text(result))
    command_line.write_json(values.json, result)


def score(run, recording, options, gate=GATE):
    """Score as a dictionary that JSON can hold. Raises InputError."""
    labels = read_labels(recording, run, options)
    if not labels:
        raise InputError(f"{recording}: no label of {options.topic} is of a scan, expected some")
    lists = {item.stamp: item for item in read_track_lists(run, [TRACKS])[TRACKS]}
    stamps = np.array(sorted(lists))
    matcher, last, distances = TrackMatcher(gate), {}, []
    found, switches = {}, []
    for stamp in sorted({label.stamp for label in labels}):
        group = [label for label in labels if label.stamp == stamp]
        tracks = _tracks_at(lists, stamps, stamp)
        apart = _distances(tracks, group)
        partners, _ = matcher.match(
            [track.id for track in tracks], [label.id for label in group],
            np.ones(len(group), dtype=bool), apart,
        )  # fmt: skip
        of_label = {column: row for row, column in enumerate(partners) if column is not None}
        for column, label in enumerate(group):
            hits, count = found.get(label.id, (0, 0))
            row = of_label.get(column)
            found[label.id] = hits + (row is not None), count + 1
            if row is None:
                continue
            distances.append(float(apart[row, column]))
            if last.setdefault(label.id, tracks[row].id) != tracks[row].id:
                switches.append({"stamp_s": stamp / NANOSECONDS, "id": label.id,
                                 "from": last[label.id], "to": tracks[row].id})  # fmt: skip
            last[label.id] = tracks[row].id
    return _result(labels, found, switches, distances, gate)


def _tracks_at(lists, stamps, stamp):
    if not len(stamps):
        return []
    nearest = stamps[np.argmin(np.abs(stamps - stamp))]
    return lists[nearest].tracks if abs(nearest - stamp) <= TRACK_TOLERANCE * NANOSECONDS else []


def _distances(tracks, group):
    """Tracks x labels, m."""
    points = np.array([track.pose[:2] for track in tracks]).reshape(-1, 1, 2)
    positions = np.array([label.position for label in group]).reshape(1, -1, 2)
    return np.linalg.norm(points - positions, axis=2)


def _result(labels, found, switches, distances, gate):
    return {
        "positions": len(labels),
        "found": len(distances),
        "found_share": len(distances) / len(labels),
        "gate_m": gate,
        "median_distance_m": float(np.median(distances)) if distances else None,
        "id_switches": len(switches),
        "ids": len(found),
        "ids_never_found": sorted(name for name, (hits, _) in found.items() if hits == 0),
        "by_id": {str(name): {"found": hits, "positions": count}
                  for name, (hits, count) in sorted(found.items())},
        "switches": switches,
    }  # fmt: skip


def text(result):
    """The score for people."""
    median = result["median_distance_m"]
    return "\n".join([
        f"labeled positions with a track within {result['gate_m']:.2f} m: {result['found']} of "
        f"{result['positions']} ({100.0 * result['found_share']:.1f} %)",
        f"median distance: {'-' if median is None else f'{median:.2f} m'}",
        f"id switches: {result['id_switches']} of {result['ids']} labeled ids; never found: "
        f"{len(result['ids_never_found'])}",
    ])  # fmt: skip
