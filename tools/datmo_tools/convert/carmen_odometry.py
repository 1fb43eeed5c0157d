# SPDX-License-Identifier: BSD-3-Clause
"""Creates odometry for a log that has only poses: rates from differences, and covariances."""

import numpy as np

from datmo_tools import transforms
from datmo_tools.convert import odometry
from datmo_tools.convert.carmen_clock import MIN_STEP
from datmo_tools.convert.odometry import OdometrySample

# Standard deviations of the rates measured by wheels indoors: slip, and coarse encoders.
SPEED_SIGMA, SPEED_RATIO = 0.02, 0.1  # m/s, and per m/s of speed
YAW_RATE_SIGMA, YAW_RATE_RATIO = 0.02, 0.1  # rad/s, and per rad/s of yaw rate


def samples(stamps, poses):
    """Returns a list of OdometrySample for increasing stamps (ns) and planar poses (x, y, yaw).

    The stack holds a twist until the next odometry message; so it is the mean to the next pose, or,
    if that is too close for a speed, to the first one at least MIN_STEP away.
    """
    rates = _rates(stamps, poses)
    result = []
    covariance = np.zeros((3, 3))
    for i, (speed, yaw_rate) in enumerate(rates):
        variances = _variances(speed, yaw_rate)
        result.append(OdometrySample(stamps[i], speed, yaw_rate, poses[i], covariance, *variances))
        if i + 1 < len(stamps):
            duration = (stamps[i + 1] - stamps[i]) * 1e-9
            covariance = odometry.propagated(
                covariance, poses[i], speed, yaw_rate, duration, variances
            )
    return result


def _rates(stamps, poses):
    """Returns (speed, yaw rate) at each stamp; the last ones repeat those before."""
    rates = []
    later = np.searchsorted(np.asarray(stamps), np.asarray(stamps) + MIN_STEP)
    for i, (stamp, j) in enumerate(zip(stamps, later)):
        if j < len(stamps):
            motion = transforms.relative(poses[i], poses[j])
            rates.append(transforms.rates_of(motion, (stamps[j] - stamp) * 1e-9))
        else:
            rates.append(rates[-1] if rates else (0.0, 0.0))
    return rates


def _variances(speed, yaw_rate):
    return (
        (SPEED_SIGMA + SPEED_RATIO * abs(speed)) ** 2,
        (YAW_RATE_SIGMA + YAW_RATE_RATIO * abs(yaw_rate)) ** 2,
    )
