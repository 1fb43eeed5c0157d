# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor could see, by the views published with its tracks."""

import math

import numpy as np

from datmo_tools.transforms import normalize_angle

# m, by which a track may be behind a beam's end point: that may be the track's own object.
BLOCKING_DISTANCE = 0.5


def is_in_view(views, position):
    """Whether a position (x, y, m, in the frame of the views) is in the sector and range of one of
    the ViewFans."""
    return any(_beam_at(view, position) is not None for view in views)


def is_visible(views, position):
    """Like that, and with nothing seen in front of it."""
    for view in views:
        beam = _beam_at(view, position)
        if beam is not None and _range(view, position) <= view.reach[beam] + BLOCKING_DISTANCE:
            return True
    return False


def _beam_at(view, position):
    """Returns the index of the fan's beam nearest to it; None: it is out of sector or range."""
    if not view.reach or view.beam_spacing == 0.0:
        return None
    if not view.min_range <= _range(view, position) <= view.range:
        return None
    bearing = math.atan2(position[1] - view.sensor.y, position[0] - view.sensor.x) - view.sensor.theta
    # Relative to the fan's middle, so that one that covers half a turn has no seam.
    half = 0.5 * (len(view.reach) - 1)
    middle = view.first_bearing + half * view.beam_spacing
    beam = round(half + float(normalize_angle(bearing - middle)) / view.beam_spacing)
    return beam if 0 <= beam < len(view.reach) else None


def _range(view, position):
    return float(np.hypot(position[0] - view.sensor.x, position[1] - view.sensor.y))
