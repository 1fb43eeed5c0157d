#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Options of the emulated scanner, and the road plane used to evaluate stereo grids."""

import unittest

import numpy as np
from datmo_tools.convert import kitti_scans
from datmo_tools.evaluate import road_plane
from datmo_tools.errors import InputError
from datmo_tools.convert.kitti_scans import ScannerOptions
from datmo_tools.evaluate.road_plane import FLAT, RoadPlane, fit_road_plane

class Scanner(unittest.TestCase):
    def test_options_that_describe_no_scanner(self):
        good = ScannerOptions()
        kitti_scans.check(good)
        for bad, name in (
            (good._replace(resolution=0.0), "--scan-resolution is 0"),
            (good._replace(resolution=3.0), "no multiple of --scan-resolution 3"),
            (good._replace(field_of_view=360.0), "--scan-fov is 360"),
            (good._replace(range_min=50.0), "--scan-range is 50 50"),
            (good._replace(band_low=1.0), "--scan-band is 1 0.9"),
            (good._replace(beam_width=2.5), "--beam-width is 2.5"),
        ):
            with self.assertRaisesRegex(InputError, name):
                kitti_scans.check(bad)

    def test_own_car(self):
        inside = kitti_scans.on_own_car(np.array([2.6, 2.8, 0.0]), np.array([0.0, 0.0, 1.2]))
        self.assertEqual(inside.tolist(), [True, False, False])


def road(plane, step=0.5):
    """Returns points of a plane, 40 m ahead and 16 m wide."""
    x, y = (
        axis.ravel() for axis in np.meshgrid(np.arange(3.0, 40.0, step), np.arange(-8.0, 8.0, step))
    )
    return np.column_stack([x, y, plane.offset + plane.slope_x * x + plane.slope_y * y])


class Road(unittest.TestCase):
    def test_heights(self):
        heights = RoadPlane(-1.7, 0.01, -0.02).heights(np.array([[10.0, 5.0, -1.0]]))
        np.testing.assert_allclose(heights, [0.7])

    def test_sloping_road_is_found_exactly(self):
        plane = RoadPlane(-1.75, 0.01, -0.02)
        np.testing.assert_allclose(fit_road_plane(road(plane)), plane, atol=1e-9)

    def test_cars_and_walls_do_not_lift_it(self):
        plane = RoadPlane(-1.70, 0.005, 0.0)
        points = road(plane)
        car = points[(points[:, 0] > 8.0) & (points[:, 0] < 12.0) & (points[:, 1] > 2.0)] + [
            0.0,
            0.0,
            0.8,
        ]
        wall = road(RoadPlane(0.5, 0.0, 0.0))
        found = fit_road_plane(np.vstack([points, car, wall]))
        np.testing.assert_allclose(found, plane, atol=0.01)

    def test_falls_back_to_the_flat_plane(self):
        self.assertEqual(fit_road_plane(np.zeros((0, 4))), FLAT)
        self.assertEqual(fit_road_plane(road(FLAT)[:20]), FLAT)
        too_deep = FLAT.offset - road_plane.MAX_HEIGHT_ERROR - 0.1
        self.assertEqual(fit_road_plane(road(RoadPlane(too_deep, 0.0, 0.0))), FLAT)


if __name__ == "__main__":
    unittest.main()
