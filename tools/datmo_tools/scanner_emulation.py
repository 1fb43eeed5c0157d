"""A planar scanner emulated from a Velodyne cloud: each beam's nearest obstacle in a band.

It is an emulation. The Velodyne looks down from 1.73 m, so it sees over low obstacles into places
that a scanner at the bumper would not see; and a band of several rows stands in for the scanner's
opening angle.
"""

import math
from typing import NamedTuple

import numpy as np

from datmo_tools.errors import InputError

# The recording car itself in the Velodyne's frame (m): its bonnet and mirrors return too, and a
# scanner at the bumper does not see them. A VW Passat, with mirrors; the bonnet's returns lie up to
# 2.53 m ahead.
CAR_REAR, CAR_FRONT, CAR_HALF_WIDTH = -2.7, 2.7, 1.15


FINEST_RESOLUTION = 0.01  # degrees: a tenth of the Velodyne's own, and not too many beams to hold


class ScannerOptions(NamedTuple):
    """Geometry of the emulated scanner; the defaults are the demonstrator's (thesis 1.3.3)."""

    resolution: float = 2.0  # degrees from beam to beam
    field_of_view: float = 160.0  # degrees, first to last beam, symmetric about straight ahead
    range_min: float = 1.0  # m
    range_max: float = 50.0  # m: beyond, one beam at most meets an object (thesis 1.3.3)
    band_low: float = 0.3  # m above the road: over kerbs and over what the road plane misses
    band_high: float = (
        0.9  # m: two rows of the Velodyne (0.4 degrees) at 40 m, under bonnets and bumpers
    )
    beam_width: float = 0.0  # degrees that a beam covers; 0: the whole way to the next beams

    @property
    def beams(self):
        """Number of beams."""
        return int(round(self.field_of_view / self.resolution)) + 1

    @property
    def covered_width(self):
        """Degrees that one beam covers."""
        return self.beam_width if self.beam_width > 0.0 else self.resolution

    @property
    def height(self):
        """Height (m) of the scanner above the road: the middle of the band."""
        return 0.5 * (self.band_low + self.band_high)

    @property
    def angle_min(self):
        """Bearing (rad) of the first beam, to the left.

        The Velodyne turns to the right: clouds of drive 0005, aligned a second apart, fit best if
        their beams are taken as 1.1 times a turn's share of time earlier towards the left.
        """
        return math.radians(0.5 * self.field_of_view)

    @property
    def angle_increment(self):
        """Angle (rad) from beam to beam, negative."""
        return -math.radians(self.resolution)

    @property
    def turn_share(self):
        """Part of the Velodyne's turn from the first to the last beam."""
        return self.field_of_view / 360.0


def check(options):
    """Raises InputError where the options describe no scanner."""
    steps = options.field_of_view / options.resolution if options.resolution > 0.0 else 0.0
    rules = (
        (
            options.resolution >= FINEST_RESOLUTION,
            f"--scan-resolution is {options.resolution:g}, expected {FINEST_RESOLUTION:g} or more",
        ),
        (
            0.0 < options.field_of_view < 360.0,
            f"--scan-fov is {options.field_of_view:g}, expected between 0 and 360 degrees",
        ),
        (
            steps >= 1.0 and abs(steps - round(steps)) < 1e-6,
            f"--scan-fov {options.field_of_view:g} is no multiple of "
            f"--scan-resolution {options.resolution:g}, expected one",
        ),
        (
            0.0 <= options.range_min < options.range_max,
            f"--scan-range is {options.range_min:g} {options.range_max:g}, expected 0 <= MIN < MAX",
        ),
        (
            options.band_low < options.band_high,
            f"--scan-band is {options.band_low:g} {options.band_high:g}, expected LOW < HIGH",
        ),
        (
            0.0 <= options.beam_width <= options.resolution,
            f"--beam-width is {options.beam_width:g}, expected 0 to {options.resolution:g}",
        ),
    )
    for holds, message in rules:
        if not holds:
            raise InputError(message)


class EmulatedScan(NamedTuple):
    """Ranges (m, +inf: no return) of the beams, and the cloud point of each (-1: none)."""

    ranges: np.ndarray
    sources: np.ndarray


def emulate_scan(cloud, heights, options):
    """The scanner's view of `cloud` (n x 3 or more columns, the Velodyne's frame).

    heights: of the points above the road (n, m). The range is the distance in the plane, and the
    beam's own bearing is reported for it, wherever in the beam the point lies.
    """
    x, y = cloud[:, 0].astype(float), cloud[:, 1].astype(float)
    distance = np.hypot(x, y)
    steps = (np.arctan2(y, x) - options.angle_min) / options.angle_increment
    beam = np.floor(steps + 0.5).astype(int)
    half_width = 0.5 * options.covered_width / options.resolution
    inside = (heights >= options.band_low) & (heights <= options.band_high)
    inside &= (distance >= options.range_min) & (distance <= options.range_max)
    inside &= (beam >= 0) & (beam < options.beams) & (np.abs(steps - beam) <= half_width)
    inside &= ~on_own_car(x, y)
    return _nearest(np.flatnonzero(inside), beam, distance, options.beams)


def on_own_car(x, y):
    """Whether points (x, y: n, m, the Velodyne's frame) lie on the recording car."""
    return (x > CAR_REAR) & (x < CAR_FRONT) & (np.abs(y) < CAR_HALF_WIDTH)


def _nearest(candidates, beam, distance, beams):
    """Nearest of the candidate points for each beam."""
    order = candidates[np.lexsort((distance[candidates], beam[candidates]))]
    hit, first = np.unique(beam[order], return_index=True)
    ranges = np.full(beams, np.inf)
    sources = np.full(beams, -1)
    sources[hit] = order[first]
    ranges[hit] = distance[order[first]]
    return EmulatedScan(ranges, sources)
