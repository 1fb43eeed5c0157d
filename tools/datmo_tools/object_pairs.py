"""Objects that two sensors saw at the same time, paired by where they are."""

from typing import NamedTuple

import numpy as np

from datmo_fusion.msg import Object
from datmo_tools import transforms
from datmo_tools.object_lists import near_side
from datmo_tools.object_scores import NEAR_ACROSS, NEAR_ALONG, THESIS_GATE
from datmo_tools.stamps import NANOSECONDS

FASTEST = 40.0  # m/s over ground: an object is not farther from itself in the next list
LENGTH_DIFFERENCE = 1.0  # m between the near sides of one object: a beam's width at 30 m, 2 degrees

# Shares of the time between two lists of the lidar up to which a line through both goes on.
LEAST_SHARE, MOST_SHARE = -0.5, 1.5


class Pair(NamedTuple):
    """One object, as both sensors saw it."""

    range: float  # m from the camera, as the lidar says
    range_difference: float  # m, the camera's less the lidar's
    bearing_difference: float  # rad
    lidar_range_variance: float  # m^2, by the lidar's own covariance
    lidar_bearing_variance: float  # rad^2


class Counts(NamedTuple):
    """What became of the camera's objects."""

    objects: int = 0
    alone: int = 0  # no lidar object is near, or nearer to another one
    unlike: int = 0  # class or length of the near side differ
    hidden: int = 0  # one of both does not see the near side with both its ends
    paired: int = 0

    def __add__(self, other):
        return Counts(*(mine + its for mine, its in zip(self, other)))


class Place(NamedTuple):
    """The near side of an object at one time, in base_link at the stamp of the camera's list."""

    seconds: float  # after that stamp
    middle: np.ndarray  # x, y, m
    covariance: np.ndarray  # 2 x 2, m^2
    length: float  # m
    classification: int


class Piece(NamedTuple):
    """A lidar object in two lists in turn: between them it moves straight on."""

    first: Place
    second: Place

    def at(self, seconds):
        """Its Place then; None: too far from both."""
        share = (seconds - self.first.seconds) / (self.second.seconds - self.first.seconds)
        if not LEAST_SHARE <= share <= MOST_SHARE:
            return None
        middle = (1.0 - share) * self.first.middle + share * self.second.middle
        covariance = (1.0 - share) ** 2 * self.first.covariance + share**2 * self.second.covariance
        length = (1.0 - share) * self.first.length + share * self.second.length
        return Place(seconds, middle, covariance, length, self.second.classification)


def paired_objects(lidar_lists, camera_lists, path, longest_gap):
    """List of Pair, and Counts.

    lidar_lists, camera_lists: of SeenList, rising; path: PosePath of the vehicle; longest_gap: s
    between two lists of the lidar.
    """
    stamps = np.array([item.stamp for item in lidar_lists])
    pairs, counts = [], Counts()
    for camera in camera_lists:
        after = _list_after(lidar_lists, stamps, camera.stamp)
        if after is None or stamps[after] - stamps[after - 1] > longest_gap * NANOSECONDS:
            continue
        first, second = (
            _places(lidar_lists[i], camera.stamp, path, camera.viewpoint)
            for i in (after - 1, after)
        )
        new_pairs, new_counts = _pairs(_pieces(first, second), camera)
        pairs += new_pairs
        counts += new_counts
    return pairs, counts


def _list_after(lists, stamps, stamp):
    """Index of the first list whose objects were seen after `stamp`; None: no list, or none before
    it."""
    after = int(np.searchsorted(stamps, stamp, side="right"))
    # A sweep's objects are seen after its stamp: the one before may be the one after.
    if after > 0 and lists[after - 1].objects:
        delay = np.median([item.delay for item in lists[after - 1].objects])
        after -= stamps[after - 1] + delay * NANOSECONDS > stamp
    return after if 0 < after < len(lists) else None


def _places(lidar, stamp, path, viewpoint):
    """Places of a list's objects, as seen from the vehicle at `stamp` (ns)."""
    pose_then, pose_now = path.at(lidar.stamp), path.at(stamp)
    late = (lidar.stamp - stamp) / NANOSECONDS
    turn = transforms.relative(pose_now, pose_then)[2]
    rotation = np.array([(np.cos(turn), -np.sin(turn)), (np.sin(turn), np.cos(turn))])
    places = []
    for item in lidar.objects:
        moved = item._replace(
            pose=transforms.relative(pose_now, transforms.compose(pose_then, item.pose)),
            covariance=rotation @ item.covariance @ rotation.T,
        )
        side = near_side(moved, viewpoint)
        places.append(
            Place(late + item.delay, side.middle, side.covariance, side.length, item.classification)
        )
    return places


def _pieces(first, second):
    """Pieces of the places of two lists."""
    if not first or not second:
        return []
    gaps = np.subtract.outer([item.seconds for item in second], [item.seconds for item in first]).T
    first_middles, second_middles = (np.array([item.middle for item in x]) for x in (first, second))
    apart = np.linalg.norm(second_middles - first_middles[:, np.newaxis], axis=2)
    possible = (gaps > 0.0) & (apart <= FASTEST * gaps)
    return [Piece(first[i], second[j]) for i, j in _mutual(np.where(possible, apart, np.inf))]


def _pairs(pieces, camera):
    viewpoint = camera.viewpoint
    sides = [near_side(item, viewpoint) for item in camera.objects]
    places = [[piece.at(item.delay) for piece in pieces] for item in camera.objects]
    distances = np.array([
        _scaled_distances(side.middle, row, viewpoint) for side, row in zip(sides, places)
    ]).reshape(len(sides), len(pieces))
    distances[distances > 1.0] = np.inf
    pairs, unlike, hidden = [], 0, 0
    found = _mutual(distances)
    for i, j in found:
        place = places[i][j]
        if not _alike(camera.objects[i], sides[i], place):
            unlike += 1
        elif not (sides[i].is_seen and np.all(np.isfinite(place.covariance))):
            hidden += 1
        else:
            pairs.append(_pair(sides[i].middle, place, viewpoint))
    count = len(sides)
    return pairs, Counts(count, count - len(found), unlike, hidden, len(pairs))


def _mutual(distances):
    """(row, column) of those that are each other's nearest."""
    if distances.size == 0:
        return []
    nearest = distances.argmin(axis=1)
    return [
        (row, column)
        for row, column in enumerate(nearest)
        if np.isfinite(distances[row, column]) and distances[:, column].argmin() == row
    ]


def _scaled_distances(seen, places, viewpoint):
    """From each of the places (n, None: infinite); 1: at the gate, an ellipse along the line of
    sight."""
    middles = np.array([(np.inf, np.inf) if item is None else item.middle for item in places])
    distances = np.full(len(places), np.inf)
    near = np.flatnonzero(np.all(np.abs(middles.reshape(-1, 2) - seen) < np.inf, axis=1))
    if len(near) > 0:
        rays = middles[near] - np.asarray(viewpoint)
        reaches = np.maximum(np.linalg.norm(rays, axis=1), np.finfo(float).tiny)
        offsets = seen - middles[near]
        along = np.sum(rays * offsets, axis=1) / reaches
        across = (rays[:, 0] * offsets[:, 1] - rays[:, 1] * offsets[:, 0]) / reaches
        gates = np.maximum(NEAR_ALONG, THESIS_GATE * reaches)
        distances[near] = np.hypot(along / gates, across / NEAR_ACROSS)
    return distances


def _alike(item, side, place):
    classes = {item.classification, place.classification} - {Object.CLASS_UNKNOWN}
    return len(classes) <= 1 and abs(side.length - place.length) <= LENGTH_DIFFERENCE


def _pair(middle, place, viewpoint):
    ray = place.middle - np.asarray(viewpoint)
    seen = middle - np.asarray(viewpoint)
    reach = float(np.hypot(*ray))
    along = ray / reach
    across = np.array([-along[1], along[0]])
    turned = transforms.normalise_angle(np.arctan2(seen[1], seen[0]) - np.arctan2(ray[1], ray[0]))
    return Pair(
        reach,
        float(np.hypot(*seen)) - reach,
        float(turned),
        float(along @ place.covariance @ along),
        float(across @ place.covariance @ across) / reach**2,
    )
