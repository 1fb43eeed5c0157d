# SPDX-License-Identifier: BSD-3-Clause
"""Creates odometry from the GPS/IMU's speed and yaw rate, with the errors of a low-cost one."""

import math
from typing import NamedTuple

import numpy as np

from datmo_tools import transforms

# Standard deviations that the messages state before noise is added: a production car's wheel speed
# and yaw rate sensors.
NOMINAL_SPEED_SIGMA = 0.1  # m/s
NOMINAL_YAW_RATE_SIGMA = 0.01  # rad/s


class OdometryErrors(NamedTuple):
    """Errors added to the true speed and yaw rate."""

    scale_error: float = 0.0  # 0.03: three percent too fast
    yaw_bias: float = 0.0  # rad/s
    speed_noise: float = 0.0  # m/s, standard deviation
    yaw_rate_noise: float = 0.0  # rad/s, standard deviation


class OdometrySample(NamedTuple):
    """Odometry at one stamp: measured rates, the pose integrated from them, and covariances."""

    stamp: int  # ns
    speed: float  # m/s
    yaw_rate: float  # rad/s
    pose: np.ndarray  # x, y (m), yaw (rad) in the frame odom
    pose_covariance: np.ndarray  # 3 x 3 of the pose
    speed_variance: float  # (m/s)^2
    yaw_rate_variance: float  # (rad/s)^2


def degraded_rates(records, errors, seed):
    """Returns measured speeds (n, m/s) and yaw rates (n, rad/s); the same seed gives the same."""
    generator = np.random.Generator(np.random.PCG64(seed))
    noise = generator.standard_normal((len(records), 2))
    speed = np.array([record.forward_speed for record in records])
    yaw_rate = np.array([record.yaw_rate for record in records])
    return (
        speed * (1.0 + errors.scale_error) + errors.speed_noise * noise[:, 0],
        yaw_rate + errors.yaw_bias + errors.yaw_rate_noise * noise[:, 1],
    )


def integrate(stamps, speeds, yaw_rates, errors):
    """Returns a list of OdometrySample: arcs between stamps at the mean of the rates at both ends.

    The covariance is propagated to first order (Thrun et al., "Probabilistic Robotics", 2005, 7.4).
    """
    variances = (
        NOMINAL_SPEED_SIGMA**2 + errors.speed_noise**2,
        NOMINAL_YAW_RATE_SIGMA**2 + errors.yaw_rate_noise**2,
    )
    pose, covariance = np.zeros(3), np.zeros((3, 3))
    samples = []
    for i, stamp in enumerate(stamps):
        if i > 0:
            duration = (stamp - stamps[i - 1]) * 1e-9
            speed, yaw_rate = 0.5 * (speeds[i - 1] + speeds[i]), 0.5 * (
                yaw_rates[i - 1] + yaw_rates[i]
            )
            covariance = propagated(covariance, pose, speed, yaw_rate, duration, variances)
            pose = transforms.compose(pose, transforms.arc(speed, yaw_rate, duration))
        samples.append(OdometrySample(stamp, speeds[i], yaw_rates[i], pose, covariance, *variances))
    return samples


def propagated(covariance, pose, speed, yaw_rate, duration, variances):
    """Returns the covariance (3 x 3) of the pose after one arc from `pose`, linearized in its
    middle.

    variances: of speed and yaw rate during the arc.
    """
    middle = pose[2] + 0.5 * yaw_rate * duration
    cosine, sine = math.cos(middle), math.sin(middle)
    traveled = speed * duration
    by_pose = np.array(
        [[1.0, 0.0, -traveled * sine], [0.0, 1.0, traveled * cosine], [0.0, 0.0, 1.0]]
    )
    by_rates = duration * np.array(
        [[cosine, -0.5 * traveled * sine], [sine, 0.5 * traveled * cosine], [0.0, 1.0]]
    )
    return by_pose @ covariance @ by_pose.T + by_rates @ np.diag(variances) @ by_rates.T
