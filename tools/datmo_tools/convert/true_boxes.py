# SPDX-License-Identifier: BSD-3-Clause
"""The boxes that the two KITTI truth readers return, before they are transformed to the map."""

from typing import NamedTuple

UNKNOWN_OCCLUSION = -1.0

# KITTI's levels (visible, partly, largely or fully hidden) as shares; any other level is unknown.
_OCCLUSION_SHARES = {0: 0.0, 1: 0.5, 2: 1.0}


class TrueBox(NamedTuple):
    """A box of one frame, upright in the Velodyne's frame."""

    x: float  # m, center
    y: float  # m
    z: float  # m, center
    yaw: float  # rad
    occlusion: float  # 0 to 1 in the annotator's view, negative: unknown


class TrueObject(NamedTuple):
    """One labeled object: its boxes by frame."""

    number: int
    label: str  # KITTI's name of the class
    length: float  # m
    width: float  # m
    height: float  # m
    boxes: dict  # frame -> TrueBox


def occlusion_share(level):
    """Returns KITTI's occlusion level as a share from 0 to 1; negative if it is unknown."""
    return _OCCLUSION_SHARES.get(int(level), UNKNOWN_OCCLUSION)
