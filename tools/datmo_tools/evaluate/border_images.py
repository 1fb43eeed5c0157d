# SPDX-License-Identifier: BSD-3-Clause
"""Projects borders into a camera's images: on the road, the plane z = 0 of base_link."""

import numpy as np

from datmo_tools import transforms
from datmo_tools.evaluate.border_recordings import edge
from datmo_tools.evaluate.border_views import BAND, SHADES, SIGMAS, line_style, opacity

STEP = 0.25  # m, sampling of a line, which the camera bends
MARKS = (10.0, 20.0, 30.0, 40.0)  # m ahead of base_link, labeled next to the borders
POINT = "#fde047"  # color of the scan, on gray


def draw_image(ax, image, moment, base):
    """Draws a Moment's scan and borders into an image on the axes.

    base: pose (x, y, yaw) of base_link in the map at the image's stamp.
    """
    height, width = image.pixels.shape[:2]
    ax.imshow(image.pixels, cmap="gray", vmin=0, vmax=255, interpolation="antialiased")
    in_map = transforms.points_in_parent(moment.base, moment.points)
    seen = image.camera.road_pixels(transforms.points_seen_from(base, in_map))
    ax.plot(*seen.T, ".", color=POINT, markersize=2.5)
    for border in moment.borders:
        _draw_border(ax, image, border, base)
    ax.set(xlim=(-0.5, width - 0.5), ylim=(height - 0.5, -0.5))
    ax.axis("off")


def _draw_border(ax, image, border, base):
    middle, left, right = (
        _finely(transforms.points_seen_from(base, edge(border, sigmas)))
        for sigmas in (0.0, SIGMAS, -SIGMAS)
    )
    shade, alpha = SHADES[border.side], opacity(border)
    outline = np.concatenate([image.camera.road_pixels(left), image.camera.road_pixels(right)[::-1]])
    outline = outline[np.isfinite(outline).all(axis=1)]
    ax.fill(*outline.T, color=shade, alpha=BAND * alpha, linewidth=0.0)
    ax.plot(*image.camera.road_pixels(middle).T, color=shade, alpha=alpha, linestyle=line_style(border))
    for mark in MARKS:
        _write_distance(ax, image, middle, mark, shade)


def _write_distance(ax, image, line, distance, shade):
    """Labels where the line first reaches a distance ahead (m)."""
    beyond = np.flatnonzero((line[:-1, 0] < distance) & (line[1:, 0] >= distance))
    if len(beyond):
        position = image.camera.road_pixels(line[beyond[:1]])[0]
        ax.plot(*position, "o", color=shade, markersize=2.5)
        ax.annotate(f"{distance:g} m", position, xytext=(2, 2), textcoords="offset points", fontsize=6,
                    color=shade, annotation_clip=True)  # fmt: skip


def _finely(line):
    """Returns the line (n x 2) with points at most STEP apart."""
    lengths = np.hypot(*np.diff(line, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(lengths)])
    positions = np.linspace(0.0, along[-1], max(2, int(np.ceil(along[-1] / STEP)) + 1))
    return np.column_stack([np.interp(positions, along, line[:, i]) for i in (0, 1)])
