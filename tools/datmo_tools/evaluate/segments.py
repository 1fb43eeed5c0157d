# SPDX-License-Identifier: BSD-3-Clause
"""Lines in the plane as straight segments: where rays cross them, and how far points are off."""

from typing import NamedTuple

import numpy as np

# Rays, or points, at a time: so many, and all segments, are in memory.
BATCH = 256

# Sine of the least angle at which a ray crosses a segment.
PARALLEL = 1e-6


class Segments(NamedTuple):
    """n straight pieces."""

    begin: np.ndarray  # n x 2, m
    end: np.ndarray  # n x 2, m

    def headings(self):
        """n, rad."""
        along = self.end - self.begin
        return np.arctan2(along[:, 1], along[:, 0])


def segments_of(lines):
    """Segments of lines (arrays n x 2 or more columns, m), in their order."""
    lines = [np.asarray(line, dtype=float)[:, :2] for line in lines]
    begin = [line[:-1] for line in lines]
    end = [line[1:] for line in lines]
    return Segments(np.concatenate([np.empty((0, 2)), *begin]),
                    np.concatenate([np.empty((0, 2)), *end]))  # fmt: skip


def ray_crossings(origins, headings, segments):
    """Where each of m rays crosses each of n segments.

    origins: m x 2, m; headings: m, rad. Returns the distance along the ray (m x n, m, negative
    behind its origin, NaN where they do not meet) and the share of the segment (m x n, 0 to 1).
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


def distances_to(points, segments):
    """Distance (m) of each point (m x 2) from the nearest segment; infinite where there is none."""
    points = np.asarray(points, dtype=float).reshape(-1, 2)
    if not len(segments.begin):
        return np.full(len(points), np.inf)
    parts = [
        _distances(points[i : i + BATCH], segments).min(axis=1)
        for i in range(0, len(points), BATCH)
    ]
    return np.concatenate([np.empty(0), *parts])


def nearby(segments, position, radius):
    """Segments that come within a radius (m) of a point."""
    near = _distances(np.asarray(position, dtype=float).reshape(1, 2), segments)[0] <= radius
    return Segments(segments.begin[near], segments.end[near])


def _distances(points, segments):
    along = segments.end - segments.begin
    square = np.maximum(np.sum(along**2, axis=1), np.finfo(float).tiny)
    apart = points[:, np.newaxis] - segments.begin[np.newaxis]
    share = np.clip(np.sum(apart * along, axis=2) / square, 0.0, 1.0)
    off = apart - share[..., np.newaxis] * along
    return np.hypot(off[..., 0], off[..., 1])


def _cross(first, second):
    return first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
