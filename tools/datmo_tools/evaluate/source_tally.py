# SPDX-License-Identifier: BSD-3-Clause
"""Counts what each source of tracks detects, misses and invents, on drives with truth."""

import math
from collections import Counter, defaultdict
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize

from datmo_fusion.msg import Object
from datmo_tools import transforms
from datmo_tools.evaluate.track_frames import Newest
from datmo_tools.evaluate.track_views import is_visible
from datmo_tools.stamps import NANOSECONDS

CLASSES = {Object.CLASS_PEDESTRIAN: "pedestrian", Object.CLASS_CYCLIST: "cyclist",
           Object.CLASS_VEHICLE: "vehicle"}  # fmt: skip
OTHER = "other"  # of no class, or of one that does not move

FALLOFF = 4.0  # m, of the law of track_fusion
NEAR = 0.01, 0.99  # bounds of its options
HALF_RANGE = 1.0, 300.0  # m

# s, over which it is remembered how much of an object a source could see, like in track_fusion.
LOOKING_TIME = 1.0


class Share(NamedTuple):
    """How many out of how many; partial counts are allowed."""

    part: float
    whole: float

    @property
    def value(self):
        """Returns the share with one more of each kind: never 0 or 1, 0.5 without any."""
        return (self.part + 1) / (self.whole + 2)


class DetectionLaw(NamedTuple):
    """near / (1 + exp((range - half_range) / FALLOFF)), like in track_fusion."""

    near: float
    half_range: float  # m

    def at(self, ranges):
        """Returns the probability at ranges (m)."""
        return self.near / (1.0 + np.exp((np.asarray(ranges) - self.half_range) / FALLOFF))


class SourceTally:
    """Counts of one source, over all added drives. Ranges, in bins: of road users m from its
    sensor, of its tracks m from the vehicle."""

    def __init__(self, bin_width):
        """bin_width: m."""
        self._bin_width = bin_width
        self.seconds = 0.0
        # Frames by (class, bin), each weighted by how much of the object could be seen lately.
        self.found, self.visible = Counter(), Counter()
        self.false = Counter()  # frames of false tracks, by bin
        # Tracks by class, each weighted by its mean probability of the class.
        self.claimed, self.true = Counter(), Counter()
        self._agreeing, self._invented = 0, 0  # frames of other sources' false tracks

    def add(self, frames):
        """Counts what it has of what it could see, and its own tracks, in TrackFrames of its lists."""
        if frames:
            self.seconds += (frames[-1].stamp - frames[0].stamp) / NANOSECONDS
        looked, before = {}, None  # id of an object -> how much of it could be seen lately
        for frame in frames:
            movers = _movers(frame)
            step = 0.0 if before is None else (frame.stamp - before) / NANOSECONDS
            before = frame.stamp
            share = 1.0 - math.exp(-step / LOOKING_TIME)
            has = set(frame.matches.objects.values())
            for number, (key, is_seen) in movers.items():
                last = looked.get(number, 0.0)
                looked[number] = last + share * (is_seen - last)
                self.visible[self._binned(key)] += looked[number]
                self.found[self._binned(key)] += looked[number] * (number in has)
            for row in range(len(frame.tracks)):
                if frame.counts(row):
                    self.false[self._bin(np.hypot(*frame.positions[row]))] += frame.is_false(row)

        self._add_claims(frames)

    def _add_claims(self, frames):
        # Each track counts once: long ones are hardly ever false, but all begin as short ones.
        of_track = defaultdict(list)  # id -> of (claims, whether it is true) by frame
        for frame in frames:
            for row, track in enumerate(frame.tracks):
                if frame.counts(row):
                    of_track[track.id].append((_claims(track.classes), not frame.is_false(row)))
        for looks in of_track.values():
            for name in (*CLASSES.values(), OTHER):
                claimed = [(claims.get(name, 0.0), is_true) for claims, is_true in looks]
                self.claimed[name] += sum(share for share, _ in claimed) / len(looks)
                self.true[name] += sum(share for share, is_true in claimed if is_true) / len(looks)

    def add_agreement(self, frames, others, gate):
        """Counts in how many frames of another source's false tracks that this one could see it has
        a track within `gate` (m) of them.

        frames: TrackFrames of this source; others: of the other one.
        """
        own = Newest(frames)
        for other in others:
            frame = own.at(other.stamp)
            for row, track in enumerate(other.tracks):
                if frame and other.is_false(row) and is_visible(frame.views, track.pose[:2]):
                    distances = [np.hypot(*(track.pose[:2] - mine.pose[:2])) for mine in frame.tracks]
                    self._invented += 1
                    self._agreeing += bool(distances) and min(distances) <= gate

    def detection(self, name, index=None):
        """Returns the share of the frames with a visible moving road user of the class in which it
        has a track of it; index: of the bin of range, or None: all."""
        keys = [key for key in self.visible if key[0] == name and index in (None, key[1])]
        return Share(sum(self.found[key] for key in keys), sum(self.visible[key] for key in keys))

    def law(self, name):
        """Returns the DetectionLaw of a class, the most likely one by the frames of all bins."""
        keys = [key for key in self.visible if key[0] == name]
        centers = np.array([self.center(key[1]) for key in keys])
        found = np.array([self.found[key] for key in keys])
        missed = np.array([self.visible[key] for key in keys]) - found

        def surprise(values):
            probability = np.clip(DetectionLaw(*values).at(centers), 1e-9, 1.0 - 1e-9)
            return -float(found @ np.log(probability) + missed @ np.log1p(-probability))

        starts = [(0.9, half) for half in (10.0, 20.0, 40.0)]  # there may be more than one minimum
        fits = [minimize(surprise, start, bounds=(NEAR, HALF_RANGE)) for start in starts]
        return DetectionLaw(*map(float, min(fits, key=lambda fit: fit.fun).x))

    def true_share(self, name):
        """Returns the share of its tracks of a class that are on objects that move at some time."""
        return Share(self.true[name], self.claimed[name])

    @property
    def false_agreement(self):
        """Returns the share of the frames of others' visible false tracks in which it agrees."""
        return Share(self._agreeing, self._invented)

    def false_per_minute(self, index):
        """Returns the frames of false tracks at the ranges of a bin, per minute."""
        return self.false[index] * 60.0 / self.seconds if self.seconds > 0.0 else 0.0

    @property
    def bins(self):
        """Returns the number of bins in which anything was counted."""
        indices = [key[1] for key in self.visible] + [*self.false]
        return max(indices, default=-1) + 1

    def center(self, index):
        """Returns the center of a bin, m."""
        return (index + 0.5) * self._bin_width

    def _bin(self, distance):
        return int(distance // self._bin_width)

    def _binned(self, key):
        name, range_of = key
        return name, self._bin(range_of)


def _claims(classes):
    """Returns a dictionary class name or OTHER -> probability, from a track's by CLASS_*."""
    claims = {name: classes[value] for value, name in CLASSES.items() if value < len(classes)}
    return {**claims, OTHER: max(0.0, 1.0 - sum(claims.values()))}


def _movers(frame):
    """Returns a dictionary id -> ((class, range from the sensor), whether the source could see it)
    of the road users that are moving now."""
    moment = frame.moment
    in_map = transforms.compose(frame.base, moment.poses)
    movers = {}
    for i, item in enumerate(moment.items):
        name = CLASSES.get(item.classification)
        if name and item.moving:
            ranges = [np.hypot(view.sensor.x - in_map[i][0], view.sensor.y - in_map[i][1])
                      for view in frame.views]  # fmt: skip
            key = name, float(min(ranges, default=np.hypot(*moment.poses[i][:2])))
            movers[int(moment.ids[i])] = key, _sees(frame.views, in_map[i], moment.sizes[i])
    return movers


# Points around a box: its corners and the centers of its sides, in half lengths and widths.
OUTLINE = np.array([(x, y, 0.0) for x in (-1, 0, 1) for y in (-1, 0, 1) if x or y])


def _sees(views, pose, size):
    """Whether at least half of the side of a box (pose in the frame of the views, size in m) that
    faces a sensor is in its view, with nothing in front of it."""
    outline = transforms.compose(pose, 0.5 * OUTLINE * [*size, 0.0])[:, :2]
    for view in views:
        sensor = view.sensor.x, view.sensor.y
        distances = np.hypot(*(outline - sensor).T)
        facing = outline[distances <= np.hypot(*(pose[:2] - sensor))]
        if 2 * sum(is_visible([view], point) for point in facing) >= len(facing):
            return True
    return False
