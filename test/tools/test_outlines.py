#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor sees of boxes, and how far two are apart, worked out by hand."""

import math
import unittest

import numpy as np
from datmo_tools.evaluate.object_lists import Seen
from datmo_tools.evaluate.outlines import Outline, offset

HIDDEN = math.inf


def seen(x, y, yaw=0.0, size=(4.0, 2.0), sides=(0.0, 0.0, 0.0, 0.0)):
    """With a variance of 0.04 m^2 along x and of 0.01 m^2 along y; sides: front,
    rear, left, right."""
    return Seen(np.array([x, y, yaw]), np.asarray(size), np.diag([0.04, 0.01]), np.array(sides),
                0, 0.0)  # fmt: skip


def outline(*position, viewpoint=(0.0, 0.0), **words):
    return Outline(seen(*position, **words), viewpoint)


class Outlines(unittest.TestCase):
    def test_line_of_sight_meets_the_near_side(self):
        for position, reach, facing in (((10.0, 0.0), 8.0, 1.0), ((10.0, 0.0, math.pi / 2), 9.0, 1.0),
                                     ((10.0, 0.0, math.pi), 8.0, 1.0),
                                     ((0.0, -5.0), None, None)):  # fmt: skip
            hit = outline(*position).hit(0.0)
            self.assertEqual(hit is None, reach is None)
            if hit is not None:
                self.assertAlmostEqual(hit.range, reach)
                self.assertAlmostEqual(hit.facing, facing)
        self.assertAlmostEqual(outline(0.0, -5.0).hit(-math.pi / 2).range, 4.0)

    def test_about_the_sensor(self):
        self.assertAlmostEqual(outline(10.0, 2.0, viewpoint=(1.5, 2.0)).hit(0.0).range, 6.5)

    def test_slanting_side(self):
        """A wall at 45 degrees through (10, 0)."""
        hit = outline(10.0, 0.0, math.pi / 4, size=(20.0, 0.0)).hit(0.0)
        self.assertAlmostEqual(hit.range, 10.0)
        self.assertAlmostEqual(hit.facing, math.sqrt(0.5))

    def test_near_point_is_in_the_middle(self):
        np.testing.assert_allclose(outline(10.0, 0.0).near_point(), (8.0, 0.0), atol=1e-9)
        np.testing.assert_allclose(outline(0.0, 0.0).near_point(), (0.0, 0.0), atol=1e-9)
        point = outline(10.0, 0.0, size=(0.0, 0.0)).near_point()
        np.testing.assert_allclose(point, (10.0, 0.0), atol=1e-9)

    def test_behind_the_sensor(self):
        """Bearings on both sides of the turn from pi to -pi."""
        seen_behind = outline(-10.0, 0.0)
        np.testing.assert_allclose(seen_behind.near_point(), (-8.0, 0.0), atol=1e-9)
        value = offset(seen_behind, outline(-10.0, 0.1)).value
        np.testing.assert_allclose(value, (0.0, 0.1), atol=0.02)

    def test_corners_that_were_seen(self):
        """Front and left face the sensor, which is behind on the right;
        the ends of both are known."""
        corners = outline(10.0, 5.0, math.pi).corners()
        self.assertEqual([corner is not None for corner in corners], [True, True, False, True])
        corners = outline(10.0, 5.0, math.pi, sides=(0.0, HIDDEN, 0.0, 0.0)).corners()
        self.assertEqual([corner is not None for corner in corners], [True, False, False, True])
        corners = outline(10.0, 0.0, math.pi, sides=(0.0, HIDDEN, 0.2, HIDDEN)).corners()
        self.assertEqual([corner is not None for corner in corners], [True, False, False, False])
        self.assertAlmostEqual(corners[0].bearing, -math.atan2(1.0, 8.0))
        self.assertAlmostEqual(corners[0].variance, 0.2 * math.cos(math.atan2(1.0, 8.0)) ** 2)


class Offsets(unittest.TestCase):
    def test_along_and_across(self):
        apart = offset(outline(10.5, 0.0), outline(10.0, 0.0))
        np.testing.assert_allclose(apart.value[0], 0.5)
        self.assertAlmostEqual(apart.range, 8.0)
        # The corners of the nearer one are equally farther apart on both sides.
        self.assertAlmostEqual(apart.value[1], 0.0)
        apart = offset(outline(10.0, 0.2), outline(10.0, 0.0))
        np.testing.assert_allclose(apart.value, (0.0, 0.2), atol=0.01)

    def test_other_headings_of_the_same_box(self):
        for yaw in (math.pi / 2, math.pi, -math.pi / 2):
            size = (2.0, 4.0) if abs(yaw) < 3.0 else (4.0, 2.0)
            apart = offset(outline(10.3, 0.1, yaw, size=size), outline(10.0, 0.0))
            np.testing.assert_allclose(apart.value, (0.3, 0.1), atol=0.02)

    def test_only_common_parts(self):
        for sides, known in (((0.0, HIDDEN, 0.0, 0.0), (False, False)),
                             ((HIDDEN, 0.0, HIDDEN, HIDDEN), (True, False)),
                             ((HIDDEN, 0.0, HIDDEN, 0.0), (True, True))):  # fmt: skip
            for pair in ((outline(10.0, 0.0, sides=sides), outline(10.0, 0.0)),
                         (outline(10.0, 0.0), outline(10.0, 0.0, sides=sides))):  # fmt: skip
                self.assertEqual(tuple(np.isfinite(offset(*pair).value)), known)

    def test_longer_box_is_not_beside(self):
        """Its left end is not visible: how far it extends beyond that is no evidence."""
        longer = seen(10.0, 0.5, size=(4.0, 3.0), sides=(0.0, 0.0, HIDDEN, 0.0))
        apart = offset(Outline(longer, (0.0, 0.0)), outline(10.0, 0.0))
        self.assertAlmostEqual(apart.value[1], 0.0)

    def test_variances(self):
        """The rear has 0.5 m^2 of its own, the left side 0.2, the right side 0.6."""
        sides = (HIDDEN, 0.5, 0.2, 0.6)
        other = outline(30.0, 0.0, sides=(HIDDEN, 0.1, 0.0, 0.0))
        apart = offset(outline(30.0, 0.0, sides=sides), other)
        np.testing.assert_allclose(apart.jacobian, np.eye(2), atol=1e-9)
        np.testing.assert_allclose(apart.sides_variance, (0.5, 0.2), rtol=0.01)
        np.testing.assert_allclose(apart.other_covariance, np.diag([0.14, 0.01]), rtol=0.01,
                                   atol=1e-3)  # fmt: skip

    def test_slanting_side_moves_along_the_line_of_sight_when_moved_across(self):
        wall = {"yaw": math.pi / 4, "size": (0.1, 0.0)}
        apart = offset(outline(10.0, 0.0, **wall), outline(10.0, 0.0, **wall))
        np.testing.assert_allclose(apart.jacobian[0], (1.0, -1.0), atol=1e-3)

    def test_sides_that_face_different_directions(self):
        apart = offset(outline(10.0, 0.0, math.pi / 4), outline(10.0, 0.0))
        self.assertTrue(np.isnan(apart.value[1]))


if __name__ == "__main__":
    unittest.main()
