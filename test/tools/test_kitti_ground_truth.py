#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Labeled boxes in the map: position, velocity, moving or not, beams on them."""

import unittest

import numpy as np
from datmo_tools import transforms
from datmo_tools.convert.ground_truth import fitted_velocities, objects_by_frame, points_in_box
from datmo_tools.convert.true_boxes import TrueBox, TrueObject, occlusion_share

BASE_FROM_VELODYNE = transforms.rigid(np.eye(3), [0.8, 0.0, 1.73])
TENTH = 10**8  # ns


def in_map(positions, ego_positions):
    """Returns objects by frame for a car at `positions` (x in the Velodyne's frame) at 10 Hz."""
    boxes = {
        frame: TrueBox(x, 2.0, -0.73, 0.1, 0.0)
        for frame, x in enumerate(positions)
        if x is not None
    }
    source = TrueObject(3, "Car", 4.0, 2.0, 1.5, boxes)
    stamps = [frame * TENTH for frame in range(len(positions))]
    poses = np.array([[x, 0.0, 0.0] for x in ego_positions])
    return objects_by_frame([source], BASE_FROM_VELODYNE, stamps, poses)


class InTheMap(unittest.TestCase):
    def test_parked_car_that_is_driven_past(self):
        frames = in_map([20.0 - i for i in range(15)], list(range(15)))
        for items in frames.values():
            np.testing.assert_allclose(items[0].pose, [20.8, 2.0, 0.1], atol=1e-12)
            self.assertAlmostEqual(items[0].z, 1.0)
            self.assertFalse(items[0].moving)
            np.testing.assert_array_equal(items[0].velocity, [0.0, 0.0])

    def test_car_ahead_at_the_same_speed(self):
        frames = in_map([20.0] * 15, list(range(15)))
        for items in frames.values():
            self.assertTrue(items[0].moving)
            np.testing.assert_allclose(items[0].velocity, [10.0, 0.0], atol=1e-9)

    def test_jittering_label_of_a_parked_car_does_not_move(self):
        jitter = [0.15 * (-1) ** i for i in range(30)]
        frames = in_map([10.0 + offset for offset in jitter], [0.0] * 30)
        self.assertFalse(any(items[0].moving for items in frames.values()))

    def test_car_that_pulls_away(self):
        frames = in_map([10.0] * 40 + [10.0 + 0.5 * i for i in range(1, 41)], [0.0] * 80)
        self.assertFalse(frames[10][0].moving)
        self.assertTrue(frames[60][0].moving)
        np.testing.assert_allclose(frames[60][0].velocity, [5.0, 0.0], atol=1e-9)

    def test_frames_without_label_and_labels_without_frame(self):
        frames = in_map([None, 10.0, None], [0.0, 0.0, 0.0])
        self.assertEqual([len(frames[i]) for i in range(3)], [0, 1, 0])
        self.assertFalse(frames[1][0].moving)

    def test_turned_vehicle(self):
        source = TrueObject(0, "Car", 4.0, 2.0, 1.5, {0: TrueBox(10.0, 2.0, -0.73, 0.0, 0.0)})
        frames = objects_by_frame(
            [source], BASE_FROM_VELODYNE, [0], np.array([[5.0, 0.0, np.pi / 2]])
        )
        np.testing.assert_allclose(frames[0][0].pose, [3.0, 10.8, np.pi / 2], atol=1e-12)


class Velocities(unittest.TestCase):
    def test_line_is_followed_exactly_with_uneven_times(self):
        seconds = np.array([0.0, 0.1, 0.25, 0.3, 0.5])
        positions = np.column_stack([1.0 + 3.0 * seconds, 2.0 - seconds])
        np.testing.assert_allclose(
            fitted_velocities(seconds, positions, 0.2), [[3.0, -1.0]] * 5, atol=1e-12
        )

    def test_alone_in_its_window(self):
        np.testing.assert_array_equal(
            fitted_velocities(np.array([0.0, 9.0]), np.eye(2), 0.5), np.zeros((2, 2))
        )


class Beams(unittest.TestCase):
    def test_points_in_a_turned_box(self):
        source = TrueObject(0, "Car", 4.0, 2.0, 1.5, {})
        box = TrueBox(10.0, 0.0, 0.0, np.pi / 2, 0.0)  # 2 m along x, 4 m along y
        points = np.array(
            [[9.1, 0.0], [10.0, 1.9], [8.9, 0.0], [8.7, 0.0], [10.0, 2.3], [10.0, -2.1]]
        )
        self.assertEqual(points_in_box(points, source, box, tolerance=0.0), 2)
        self.assertEqual(points_in_box(points, source, box, tolerance=0.2), 4)
        self.assertEqual(points_in_box(np.zeros((0, 4)), source, box), 0)

    def test_occlusion_levels(self):
        self.assertEqual(
            [occlusion_share(level) for level in (0, 1, 2, 3, -1)], [0.0, 0.5, 1.0, -1.0, -1.0]
        )


if __name__ == "__main__":
    unittest.main()
