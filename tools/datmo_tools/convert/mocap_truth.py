# SPDX-License-Identifier: BSD-3-Clause
"""Where motion capture observed a body, and how fast it was."""

from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.convert.ground_truth import fitted_velocities
from datmo_tools.errors import InputError
from datmo_tools.pose_path import PosePath, read_path

# Half the time over which a line is fitted to poses: a millimeter of noise at 120 poses per second
# is then 3 mm/s, and a car's acceleration hardly changes.
HALF_WINDOW = 0.1  # s

# Where motion capture lost the markers for longer than this, there is no truth.
MAX_GAP = 50_000_000  # ns, to the nearest pose


def seen_path(recording, topic):
    """Returns the PosePath of the poses on `topic` at which motion capture observed the markers.

    When it does not, it repeats the last pose; a body at rest is measured with noise. Raises
    InputError like read_path, and if nothing else is left.
    """
    path = read_path(recording, topic)
    news = np.any(np.diff(path.poses, axis=0) != 0.0, axis=1)
    seen = np.concatenate([[True], news])
    if np.count_nonzero(seen) < 2:
        raise InputError(f"{recording}: {topic} never changes, expected motion capture poses")
    return PosePath(path.stamps[seen], path.poses[seen])


class BodyState(NamedTuple):
    """A body at one stamp, in the map."""

    pose: np.ndarray  # x, y (m), yaw (rad)
    velocity: np.ndarray  # vx, vy in m/s
    yaw_rate: float  # rad/s

    @property
    def forward_speed(self):
        """Returns the velocity along the heading, m/s."""
        return float(self.velocity @ [np.cos(self.pose[2]), np.sin(self.pose[2])])


class CapturedBody:
    """A body over time."""

    def __init__(self, path, origin, center):
        """path: PosePath of the markers; origin: the map's pose in their frame; center: the body's
        in the markers' (both x, y, yaw)."""
        local = transforms.relative(origin, path.poses)
        poses = np.array([transforms.compose(pose, center) for pose in local])
        self.path = PosePath(path.stamps, poses)
        self._seconds = (path.stamps - path.stamps[0]) * 1e-9
        yaws = np.unwrap(poses[:, 2])[:, None]
        positions = np.column_stack([poses[:, :2], yaws])
        self._rates = fitted_velocities(self._seconds, positions, HALF_WINDOW)

    def at(self, stamp):
        """Returns the BodyState at `stamp` (ns); None if motion capture did not observe it."""
        if self.path.distance_from(stamp) > MAX_GAP:
            return None
        instant = (stamp - self.path.stamps[0]) * 1e-9
        vx, vy, yaw_rate = (np.interp(instant, self._seconds, rate) for rate in self._rates.T)
        return BodyState(self.path.at(stamp), np.array([vx, vy]), float(yaw_rate))
