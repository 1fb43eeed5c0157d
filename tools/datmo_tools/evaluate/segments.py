# SPDX-License-Identifier: BSD-3-Clause
"""Straight line segments in the plane, and where many rays cross them, all at once."""

from typing import NamedTuple

import numpy as np

# Rays at a time: for these, with all segments, arrays are in memory.
BATCH = 256

# Sine of the smallest angle at which a ray crosses a segment.
PARALLEL = 1e-6


class Segments(NamedTuple):
    """n straight segments."""

    begin: np.ndarray  # n x 2, m
    end: np.ndarray  # n x 2, m

    def headings(self):
        """n, rad."""
        along = self.end - self.begin
        return np.arctan2(along[:, 1], along[:, 0])


def segments_of(lines):
    """Returns the Segments of lines (arrays n x 2 or more columns, m), in order."""
    lines = [np.asarray(line, dtype=float)[:, :2] for line in lines]
    begin = [line[:-1] for line in lines]
    end = [line[1:] for line in lines]
    return Segments(np.concatenate([np.empty((0, 2)), *begin]),
                    np.concatenate([np.empty((0, 2)), *end]))  # fmt: skip


def ray_crossings(origins, headings, segments):
    """Computes where each of m rays crosses each of n segments.

    origins: m x 2, m; headings: m, rad. Returns the distance along the ray (m x n, m, negative
    behind its origin, NaN without crossing) and the position on the segment (m x n, 0 to 1).
    """
    ray = np.stack([np.cos(headings), np.sin(headings)], axis=-1)[:, np.newaxis]
    along = (segments.end - segments.begin)[np.newaxis]
    apart = segments.begin[np.newaxis] - np.asarray(origins)[:, np.newaxis]
    slant = _cross(ray, along)
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = _cross(apart, along) / slant
        share = _cross(apart, ray) / slant
    length = np.hypot(along[..., 0], along[..., 1])
    meet = (share >= 0.0) & (share <= 1.0) & (np.abs(slant) > PARALLEL * length)
    return np.where(meet, distance, np.nan), share


def _cross(first, second):
    return first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
