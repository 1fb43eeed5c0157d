# SPDX-License-Identifier: BSD-3-Clause
"""Predicts objects of two sensors to one time, and pairs them by position with score_run's matcher."""

from typing import NamedTuple

import numpy as np

from datmo_fusion.msg import Object
from datmo_tools import transforms
from datmo_tools.evaluate.object_lists import Seen, SeenList
from datmo_tools.evaluate.object_scores import NEAR_ACROSS, NEAR_ALONG, THESIS_GATE
from datmo_tools.evaluate.outlines import Outline, offset
from datmo_tools.evaluate.pair_choice import nearest_pairs
from datmo_tools.stamps import NANOSECONDS

# s, from an image to the scan nearest in time: more than half a turn of a slow scanner.
MAX_GAP = 0.1

TRACK_MARGIN = 1.0  # m: a track's object is in its box, or this far outside
SIZE_DIFFERENCE = 1.5  # m: between the widths of two sensors; two beams of 2 degrees at 20 m


class Pair(NamedTuple):
    """One object, as seen by both sensors; NaN: not seen by both."""

    range: float  # m from the camera to the center of its box, by the camera
    range_difference: float  # m, the camera's minus the lidar's
    bearing_difference: float  # rad
    known_range_variance: float  # m^2: of the lidar, and of the sides that the camera saw
    known_bearing_variance: float  # rad^2


class Counts(NamedTuple):
    """What happened to the lidar's objects that are tracked as moving, at the stamps of images."""

    objects: int = 0
    alone: int = 0  # no object of the camera is near, or it is another one's
    unlike: int = 0  # class or size differ
    hidden: int = 0  # no part of them was seen by both
    paired: int = 0

    def __add__(self, other):
        return Counts(*(mine + its for mine, its in zip(self, other)))


class Observation(NamedTuple):
    """A moving object of the lidar, in base_link at the stamp of the camera's list."""

    item: Seen
    seconds: float  # after that stamp, when it was seen
    velocity: np.ndarray  # m/s over ground: vx, vy

    def at(self, seconds):
        """Returns the Seen predicted to that stamp."""
        displacement = self.velocity * (seconds - self.seconds)
        return self.item._replace(pose=self.item.pose + np.append(displacement, 0.0))


class View(NamedTuple):
    """The objects of both sensors at the stamp of one image."""

    observations: list  # n of Observation
    camera: SeenList  # of m objects
    outlines: list  # m of Outline
    others: list  # n x m of Outline: the observations at the camera's times
    distances: np.ndarray  # n x m, scaled to 1 at the gate; infinite: beyond


def paired_objects(lidar_lists, camera_lists, tracks, path):
    """Returns a list of Pair, and Counts.

    lidar_lists, camera_lists: of SeenList; tracks: dictionary stamp of a scan (ns) -> list of
    MovingBox; path: PosePath of the vehicle.
    """
    tracked = [item for item in lidar_lists if item.stamp in tracks]
    times = np.array([item.stamp + _delay(item) for item in tracked])
    views = []
    for camera in camera_lists if tracked else ():
        apart = np.abs(times - camera.stamp)
        nearest = int(np.argmin(apart))
        if apart[nearest] <= MAX_GAP * NANOSECONDS:
            lidar = tracked[nearest]
            observations = _observations(lidar, tracks[lidar.stamp], camera.stamp, path)
            views.append(_view(observations, camera))
    pairs, counts = [], Counts()
    for view, found in zip(views, nearest_pairs([view.distances for view in views])):
        new_pairs, new_counts = _pairs(view, found)
        pairs += new_pairs
        counts += new_counts
    return pairs, counts


def _delay(item):
    """Returns the median delay (ns) of a list's objects after its stamp."""
    return np.median([seen.delay for seen in item.objects] or [0.0]) * NANOSECONDS


def _observations(lidar, boxes, stamp, path):
    """Returns a list's objects with a track, as seen from the vehicle at `stamp` (ns)."""
    pose_then, pose_now = path.at(lidar.stamp), path.at(stamp)
    late = (lidar.stamp - stamp) / NANOSECONDS
    turn = transforms.relative(pose_now, pose_then)[2]
    observations = []
    for item in lidar.objects:
        in_map = transforms.compose(pose_then, item.pose)
        box = _box_on(in_map, boxes)
        if box is not None:
            rotation = _rotation(turn)
            moved = item._replace(
                pose=transforms.relative(pose_now, in_map),
                covariance=rotation @ item.covariance @ rotation.T,
            )
            velocity = _rotation(-pose_now[2]) @ box.velocity
            observations.append(Observation(moved, late + item.delay, velocity))
    return observations


def _rotation(angle):
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([(cosine, -sine), (sine, cosine)])


def _box_on(pose, boxes):
    """Returns the nearest MovingBox, by center, of those that contain a position (x, y, ..., m)."""
    near = [
        (np.hypot(*(box.pose[:2] - pose[:2])), i)
        for i, box in enumerate(boxes)
        if np.all(np.abs(transforms.relative(box.pose, pose)[:2]) <= 0.5 * box.size + TRACK_MARGIN)
    ]
    return boxes[min(near)[1]] if near else None


def _view(observations, camera):
    """Returns the View of one image."""
    outlines = [Outline(item, camera.viewpoint) for item in camera.objects]
    others = [
        [Outline(observation.at(item.delay), camera.viewpoint) for item in camera.objects]
        for observation in observations
    ]
    distances = np.array([
        [_scaled_distance(mine.near_point(), its.near_point()) for mine, its in zip(outlines, row)]
        for row in others
    ]).reshape(len(observations), len(outlines))  # fmt: skip
    distances[distances > 1.0] = np.inf
    return View(observations, camera, outlines, others, distances)


def _pairs(view, found):
    """Returns the list of Pair and the Counts of one image; found: of nearest_pairs."""
    pairs, unlike = [], 0
    for i, j in found:
        if not _alike(view.observations[i].item, view.camera.objects[j]):
            unlike += 1
            continue
        apart = offset(view.outlines[j], view.others[i][j])
        if not np.all(np.isnan(apart.value)):
            pairs.append(_pair(view.camera.objects[j], apart, view.camera.viewpoint))
    hidden = len(found) - unlike - len(pairs)
    total = len(view.observations)
    return pairs, Counts(total, total - len(found), unlike, hidden, len(pairs))


def _scaled_distance(seen, position):
    """Returns the distance; 1: at the gate, an ellipse along the line of sight to `position`."""
    reach = max(float(np.hypot(*position)), np.finfo(float).tiny)
    along = position / reach
    apart = seen - position
    across = along[0] * apart[1] - along[1] * apart[0]
    return np.hypot(apart @ along / max(NEAR_ALONG, THESIS_GATE * reach), across / NEAR_ACROSS)


def _alike(one, other):
    """Whether classes and sizes are compatible; longer sides may be seen only partly."""
    classes = {one.classification, other.classification} - {Object.CLASS_UNKNOWN}
    shorter = min(one.size), min(other.size)
    return len(classes) <= 1 and abs(shorter[0] - shorter[1]) <= SIZE_DIFFERENCE


def _pair(item, apart, viewpoint):
    known = np.diag(apart.other_covariance) + apart.sides_variance
    return Pair(
        float(np.linalg.norm(item.pose[:2] - np.asarray(viewpoint))),
        float(apart.value[0]),
        float(apart.value[1]) / apart.range,
        float(known[0]),
        float(known[1]) / apart.range**2,
    )
