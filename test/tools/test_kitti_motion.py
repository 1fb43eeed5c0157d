#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Transforms, the car's true pose, and its odometry."""

import math
import unittest

import numpy as np
from datmo_tools import transforms
from datmo_tools.convert import odometry
from datmo_tools.convert.ego_pose import EgoMotion, course_offset, poses_from_gps, poses_from_velocity
from datmo_tools.convert.kitti_raw import Oxts
from datmo_tools.convert.odometry import OdometryErrors
from tiny_drive import METER_IN_LONGITUDE

SECOND = 10**9
RIGHT_ANGLE = math.pi / 2


def driving(count, speed=10.0, yaw_rate=0.0, yaw=0.0, step=SECOND, leftward=0.0):
    """Returns stamps (ns) and records of constant speed and yaw rate;
    longitude as if it drove east."""
    seconds = [i * step / SECOND for i in range(count)]
    records = [
        Oxts(
            0.0, 8.0 + speed * t * METER_IN_LONGITUDE, yaw + yaw_rate * t, speed, leftward, yaw_rate
        )
        for t in seconds
    ]
    return [i * step for i in range(count)], records


class Transforms(unittest.TestCase):
    def test_compose_and_relative_undo_each_other(self):
        a, b = np.array([1.0, 2.0, 3.0]), np.array([-4.0, 0.5, -2.9])
        np.testing.assert_allclose(transforms.relative(a, transforms.compose(a, b)), b, atol=1e-12)

    def test_compose_turns_left(self):
        pose = transforms.compose(np.array([1.0, 1.0, RIGHT_ANGLE]), [2.0, 1.0, 0.0])
        np.testing.assert_allclose(pose, [0.0, 3.0, RIGHT_ANGLE], atol=1e-12)

    def test_arc(self):
        np.testing.assert_allclose(transforms.arc(2.0, 0.0, 3.0), [6.0, 0.0, 0.0])
        quarter = transforms.arc(RIGHT_ANGLE * 5.0, RIGHT_ANGLE, 1.0)  # radius 5 m
        np.testing.assert_allclose(quarter, [5.0, 5.0, RIGHT_ANGLE], atol=1e-12)

    def test_quaternion_turns_as_its_matrix(self):
        for rotation in (
            np.eye(3),
            [[0, -1, 0], [0, 0, -1], [1, 0, 0]],
            [[1, 0, 0], [0, -1, 0], [0, 0, -1]],
        ):
            x, y, z, w = transforms.quaternion_of(np.array(rotation, dtype=float))
            matrix = [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
            np.testing.assert_allclose(matrix, rotation, atol=1e-12)

    def test_inverse(self):
        transform = transforms.rigid([[0, -1, 0], [1, 0, 0], [0, 0, 1]], [1.0, 2.0, 3.0])
        np.testing.assert_allclose(transforms.inverse(transform) @ transform, np.eye(4), atol=1e-12)


class EgoPose(unittest.TestCase):
    def test_velocity_and_gps_agree_on_a_straight_road(self):
        stamps, records = driving(3)
        expected = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [20.0, 0.0, 0.0]]
        np.testing.assert_allclose(poses_from_velocity(stamps, records), expected, atol=1e-9)
        np.testing.assert_allclose(poses_from_gps(records), expected, atol=1e-6)

    def test_first_heading_is_the_maps_x_axis(self):
        stamps, records = driving(
            3, yaw=RIGHT_ANGLE
        )  # faces north, the GPS walks east: to its right
        np.testing.assert_allclose(poses_from_gps(records)[2], [0.0, -20.0, 0.0], atol=1e-6)
        np.testing.assert_allclose(
            poses_from_velocity(stamps, records)[2], [20.0, 0.0, 0.0], atol=1e-9
        )

    def test_gps_at_latitude_60_is_half_as_wide(self):
        records = [
            Oxts(60.0, 8.0 + 2.0 * i * METER_IN_LONGITUDE, 0.0, 0.0, 0.0, 0.0) for i in range(2)
        ]
        np.testing.assert_allclose(poses_from_gps(records)[1], [1.0, 0.0, 0.0], atol=1e-6)

    def test_circle_closes(self):
        stamps, records = driving(
            1001, speed=10.0, yaw_rate=2.0 * math.pi / 100.0, step=SECOND // 10
        )
        poses = poses_from_velocity(stamps, records)
        np.testing.assert_allclose(poses[-1, :2], [0.0, 0.0], atol=1e-6)
        np.testing.assert_allclose(poses[500, :2], [0.0, 1000.0 / math.pi], atol=0.01)

    def test_gps_unit_that_is_mounted_askew(self):
        """10 m/s ahead and 1 m/s to the left: it faces to the right of its course."""
        for speed, leftward in ((10.0, 1.0), (-10.0, -1.0)):
            stamps, records = driving(2, speed=speed, leftward=leftward)
            self.assertAlmostEqual(course_offset(records), math.atan(0.1))
            expected = transforms.compose(np.array([0.0, 0.0, math.atan(0.1)]), [speed, 0.0, 0.0])[
                :2
            ]
            np.testing.assert_allclose(
                poses_from_velocity(stamps, records)[1], [*expected, 0.0], atol=1e-9
            )
        self.assertEqual(course_offset(driving(3, speed=0.0)[1]), 0.0)

    def test_between_and_beyond_the_records(self):
        stamps, records = driving(3)
        ego = EgoMotion(stamps, records, poses_from_velocity(stamps, records))
        for seconds, x in (
            (0.0, 0.0),
            (0.25, 2.5),
            (1.0, 10.0),
            (1.5, 15.0),
            (2.0, 20.0),
            (2.1, 21.0),
            (-0.1, -1.0),
        ):
            pose = ego.pose_at(int(seconds * SECOND))
            np.testing.assert_allclose(pose, [x, 0.0, 0.0], atol=1e-9, err_msg=f"at {seconds} s")


class Odometry(unittest.TestCase):
    def integrated(self, count, errors, seed=0, **motion):
        stamps, records = driving(count, **motion)
        return odometry.integrate(stamps, *odometry.degraded_rates(records, errors, seed), errors)

    def test_without_errors_it_is_the_truth(self):
        samples = self.integrated(5, OdometryErrors(), yaw_rate=0.2)
        np.testing.assert_allclose(
            samples[-1].pose, [50.0 * math.sin(0.8), 50.0 * (1 - math.cos(0.8)), 0.8]
        )

    def test_scale_error_and_yaw_bias(self):
        samples = self.integrated(2, OdometryErrors(scale_error=0.03))
        np.testing.assert_allclose(samples[-1].pose, [10.3, 0.0, 0.0])
        samples = self.integrated(11, OdometryErrors(yaw_bias=math.radians(0.5)))
        self.assertAlmostEqual(samples[-1].pose[2], math.radians(5.0))
        self.assertAlmostEqual(samples[-1].yaw_rate, math.radians(0.5))

    def test_noise_is_seeded_and_as_large_as_asked(self):
        _, records = driving(4000)
        errors = OdometryErrors(speed_noise=0.5, yaw_rate_noise=0.02)
        speeds, yaw_rates = odometry.degraded_rates(records, errors, seed=3)
        self.assertAlmostEqual(float(np.std(speeds)), 0.5, delta=0.03)
        self.assertAlmostEqual(float(np.std(yaw_rates)), 0.02, delta=0.0012)
        again, _ = odometry.degraded_rates(records, errors, seed=3)
        other, _ = odometry.degraded_rates(records, errors, seed=4)
        np.testing.assert_array_equal(speeds, again)
        self.assertTrue(np.all(speeds != other))

    def test_covariance_is_what_many_drives_scatter(self):
        errors = OdometryErrors(
            speed_noise=math.sqrt(0.5**2 - odometry.NOMINAL_SPEED_SIGMA**2),
            yaw_rate_noise=math.sqrt(0.02**2 - odometry.NOMINAL_YAW_RATE_SIGMA**2),
        )
        stated = self.integrated(11, errors)[-1]
        self.assertAlmostEqual(stated.speed_variance, 0.25)
        generator = np.random.default_rng(1)
        ends = []
        for _ in range(1500):  # one draw for each step, as the propagation takes it
            poses = np.zeros(3)
            for speed, yaw_rate in zip(
                10.0 + 0.5 * generator.standard_normal(10), 0.02 * generator.standard_normal(10)
            ):
                poses = transforms.compose(poses, transforms.arc(speed, yaw_rate, 1.0))
            ends.append(poses)
        np.testing.assert_allclose(
            np.sqrt(np.diag(np.cov(np.array(ends).T))),
            np.sqrt(np.diag(stated.pose_covariance)),
            rtol=0.1,
        )


if __name__ == "__main__":
    unittest.main()
