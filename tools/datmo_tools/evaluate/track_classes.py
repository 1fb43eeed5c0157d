# SPDX-License-Identifier: BSD-3-Clause
"""The classes of a run's tracks and the true ones, by score_run's matches."""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.evaluate.box_crops import Box
from datmo_tools.evaluate.class_tally import NOTHING, UNKNOWN, Report
from datmo_tools.evaluate.object_tally import NAMES
from datmo_tools.evaluate.score_run import matches_by
from datmo_tools.evaluate.track_lists import read_track_lists
from datmo_tools.evaluate.truth import read_true_objects
from datmo_tools.pose_path import read_path
from datmo_tools.text_table import percent

HEADINGS = ("true object", "true class", "its tracks", "frames", "right, %", "class unknown")


class TrackClasses(NamedTuple):
    """What a run reports about the classes of its tracks."""

    reports: list  # of Report, also those of no known class
    path: object  # PosePath of the vehicle in the map of the run

    @property
    def known(self):
        """Returns the reports of a class."""
        return [item for item in self.reports if item.said != UNKNOWN]


def read_track_classes(run, truth, words, options, program=None):
    """Returns the TrackClasses of the bag `run` (Path): one Report for each track of a true object,
    or of none, in each frame; those beside an object that has another track are left out.

    truth: bag with the truth (Path), or None: the run's; words: for score_run, that set options;
    options: all of them, as it reports them (dictionary); program: score_run, by default the found
    one. Raises InputError.
    """
    topic = options["topics/tracks"]
    lists = read_track_lists(run, [topic])[topic]
    found, path = matches_by(run, truth, words, program), read_path(run, options["topics/pose"])
    classes = {item.id: NAMES.get(item.classification, UNKNOWN)
               for items in read_true_objects(truth or run).values() for item in items}  # fmt: skip
    reports = [
        _report(track, item.stamp, path, found[item.stamp].objects.get(track.id), classes)
        for item in lists
        if item.stamp in found
        for track in item.tracks
        if track.id in found[item.stamp].objects or track.id in found[item.stamp].false
    ]
    return TrackClasses(reports, path)


def _report(track, stamp, path, true_id, classes):
    position = transforms.relative(path.at(stamp), track.pose)[:2]
    true = NOTHING if true_id is None else classes.get(true_id, UNKNOWN)
    return Report(NAMES.get(track.classification, UNKNOWN), track.class_probability, true,
                  float(np.hypot(*position)), stamp, Box(track.pose, track.size, track.velocity),
                  track.id, true_id)  # fmt: skip


def by_object(reports):
    """Returns a dictionary true object's id -> its class, tracks (ids), frames, and in how many of
    them the class is right, or not known."""
    objects = {}
    for item in reports:
        if item.true_id is not None and item.true != UNKNOWN:
            entry = objects.setdefault(item.true_id, {"class": item.true, "tracks": [], "frames": 0,
                                                      "right": 0, "silent": 0})  # fmt: skip
            if item.track not in entry["tracks"]:
                entry["tracks"].append(item.track)
            entry["frames"] += 1
            entry["right"] += item.is_right
            entry["silent"] += item.said == UNKNOWN
    return dict(sorted(objects.items()))


def object_rows(objects):
    """Returns the rows of a table of by_object()."""
    rows = [(str(number), item["class"], " ".join(map(str, item["tracks"])), str(item["frames"]),
             percent(item["right"] / item["frames"]), str(item["silent"]))
            for number, item in objects.items()]  # fmt: skip
    return (HEADINGS, *rows) if rows else ()
