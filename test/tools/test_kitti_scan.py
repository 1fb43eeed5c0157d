#!/usr/bin/python3
"""The emulated scanner and the road under it, point by point."""

import math
import unittest

import numpy as np
from datmo_tools import road_plane, scanner_emulation
from datmo_tools.errors import InputError
from datmo_tools.road_plane import FLAT, RoadPlane, fit_road_plane
from datmo_tools.scanner_emulation import ScannerOptions, emulate_scan

AHEAD = 40  # beam of the default scanner that looks straight ahead


def scan(polar, options=ScannerOptions(), height=0.5):
    """Scan of points given as (distance in m, bearing in degrees), all at one height."""
    bearing = np.radians([point[1] for point in polar])
    distance = np.array([point[0] for point in polar])
    points = np.column_stack([distance * np.cos(bearing), distance * np.sin(bearing)])
    return emulate_scan(points, np.full(len(points), height), options)


class EmulatedScanner(unittest.TestCase):
    def test_demonstrator_has_81_beams(self):
        options = ScannerOptions()
        self.assertEqual(options.beams, 81)
        self.assertAlmostEqual(options.angle_min + 80 * options.angle_increment, -math.radians(80.0))
        self.assertEqual(options._replace(resolution=1.0).beams, 161)
        self.assertEqual(options._replace(resolution=0.25).beams, 641)

    def test_beams_are_centred_on_their_bearings_from_left_to_right(self):
        for bearing, beam in (
            (0.0, 40),
            (0.9, 40),
            (-0.9, 40),
            (1.1, 39),
            (80.0, 0),
            (-80.9, 80),
            (45.0, 18),
        ):
            ranges = scan([(10.0, bearing)]).ranges
            self.assertEqual(
                np.flatnonzero(np.isfinite(ranges)).tolist(), [beam], f"bearing {bearing}"
            )
            self.assertAlmostEqual(ranges[beam], 10.0)

    def test_outside_the_field_of_view(self):
        self.assertFalse(
            np.any(np.isfinite(scan([(10.0, 81.1), (10.0, -81.1), (10.0, 180.0)]).ranges))
        )

    def test_nearest_of_a_beam_and_where_it_came_from(self):
        result = scan([(20.0, 0.0), (10.0, 0.5), (15.0, -0.5), (30.0, 20.0)])
        self.assertAlmostEqual(result.ranges[AHEAD], 10.0)
        self.assertEqual((result.sources[AHEAD], result.sources[AHEAD - 10]), (1, 3))
        self.assertEqual(np.count_nonzero(result.sources >= 0), 2)
        self.assertTrue(np.all(np.isinf(result.ranges[result.sources < 0])))

    def test_thin_beams_miss_what_is_between_them(self):
        thin = ScannerOptions(beam_width=0.4)
        self.assertAlmostEqual(scan([(10.0, 0.19)], thin).ranges[AHEAD], 10.0)
        self.assertFalse(np.any(np.isfinite(scan([(10.0, 0.21), (10.0, 1.0)], thin).ranges)))

    def test_range_limits(self):
        side = 60.0  # degrees, clear of the car itself
        for distance, seen in ((0.9, False), (4.0, True), (49.9, True), (50.1, False)):
            self.assertEqual(
                np.any(np.isfinite(scan([(distance, side)]).ranges)), seen, f"{distance} m"
            )

    def test_height_band(self):
        for height, seen in ((0.29, False), (0.3, True), (0.9, True), (0.91, False)):
            self.assertEqual(
                np.isfinite(scan([(10.0, 0.0)], height=height).ranges[AHEAD]), seen, f"{height} m"
            )

    def test_own_car_is_not_seen(self):
        self.assertFalse(np.any(np.isfinite(scan([(2.5, 10.0), (1.8, -35.0)]).ranges)))
        self.assertTrue(np.any(np.isfinite(scan([(2.8, 0.0)]).ranges)))

    def test_no_points(self):
        self.assertTrue(np.all(np.isinf(scan([]).ranges)))

    def test_options_that_describe_no_scanner(self):
        good = ScannerOptions()
        scanner_emulation.check(good)
        for bad, name in (
            (good._replace(resolution=0.0), "--scan-resolution is 0"),
            (good._replace(resolution=3.0), "no multiple of --scan-resolution 3"),
            (good._replace(field_of_view=360.0), "--scan-fov is 360"),
            (good._replace(range_min=50.0), "--scan-range is 50 50"),
            (good._replace(band_low=1.0), "--scan-band is 1 0.9"),
            (good._replace(beam_width=2.5), "--beam-width is 2.5"),
        ):
            with self.assertRaisesRegex(InputError, name):
                scanner_emulation.check(bad)


def road(plane, step=0.5):
    """Points of a plane, 40 m ahead and 16 m wide."""
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
