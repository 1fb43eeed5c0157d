# SPDX-License-Identifier: BSD-3-Clause
"""Odometry, IMU and twist against the motion that the scans see."""

import math
from typing import NamedTuple, Optional

import numpy as np

from datmo_tools.check_bag.motion_fit import MotionFit, fit_distances, fit_turns
from datmo_tools.check_bag.motion_signal import MotionSignal

MAX_SCALE_ERROR = 0.06  # of the scale, from which on it is reported
SURE = 3.0  # standard deviations
MAX_DELAY = 0.06  # s
MIN_GAIN = 1.15  # of the cost, that a delay must bring
MAX_MOUNT_YAW = math.radians(4.0)
MIN_MOUNT_PAIRS = 20
MIN_SHIFT = 0.05  # m, from which on a shift has a direction
STANDING_SPEED = 0.02  # m/s
STANDING_TURN = 0.01  # rad/s


class MotionResult(NamedTuple):
    """One signal and how it fits the scans."""

    signal: MotionSignal
    turns: Optional[MotionFit]
    distances: Optional[MotionFit]

    @property
    def misfit(self):
        """What is left between signal and scans, in units of the floor; inf: not known."""
        fits = [(self.turns, 0.0015), (self.distances, 0.005)]
        parts = [
            fit.noise / floor * (1.0 + 10.0 * abs(abs(fit.scale) - 1.0))
            for fit, floor in fits if fit is not None
        ]  # fmt: skip
        return sum(parts) / len(parts) if parts else math.inf


def motion_signals(recording, roles):
    """Dictionary role -> MotionSignal: pose and twist of the odometry, twist, imu."""
    signals = {}
    if roles.odometry in recording.odometry:
        samples = recording.odometry[roles.odometry]
        signals["pose"] = samples.by_pose(roles.odometry)
        signals["twist_of_odometry"] = samples.by_twist(roles.odometry)
    if roles.twist in recording.twists:
        signals["twist"] = recording.twists[roles.twist].signal(roles.twist)
    if roles.imu in recording.imus:
        samples = recording.imus[roles.imu]
        signals["imu"] = samples.signal(roles.imu, samples.up())
    return {name: signal for name, signal in signals.items() if signal is not None}


def vehicle_moved(signals):
    """Whether any signal says that the vehicle moves for a while; True where none can say."""
    if not signals:
        return True
    for signal in signals.values():
        speeds = signal.speeds()
        if len(speeds) and np.percentile(speeds, 80) > STANDING_SPEED:
            return True
        if signal.headings is not None and np.ptp(signal.headings) > 0.3:
            return True
    return False


def compare(signals, motions, base_motions):
    """Dictionary role -> MotionResult."""
    return {
        name: MotionResult(
            signal,
            fit_turns(signal, motions),
            fit_distances(signal, motions, base_motions) if base_motions is not None else None,
        )
        for name, signal in signals.items()
    }


def check_motion(results, roles, findings):
    """Adds where odometry, twist and IMU disagree with the scans."""
    unused = _unused(results)
    for name, result in results.items():
        if name == unused:
            continue
        where = {"imu": roles.imu, "twist": roles.twist}.get(name, roles.odometry)
        _check_turns(result, where, findings)
        _check_distances(result, where, findings)
    _check_pose_against_twist(results, roles, findings)


def poses_are_better(results):
    """Whether the poses of the odometry fit the scans better than its twist; None: no odometry."""
    pose, twist = results.get("pose"), results.get("twist_of_odometry")
    if pose is None:
        return None
    if twist is None or (_is_dead(twist.signal) and not _is_dead(pose.signal)):
        return True
    return pose.misfit < 0.9 * twist.misfit


def _unused(results):
    """That half of the odometry which the yaml does not take."""
    return "twist_of_odometry" if poses_are_better(results) else "pose"


def _check_turns(result, where, findings):
    fit, source = result.turns, result.signal.source
    if fit is None:
        return
    if fit.scale < -0.3:
        findings.error(
            "yaw_sign", where,
            f"{source} turns left where the scans turn right (scale {fit.scale:.2f})",
            "Either the yaw has the wrong sign (z must point up, left is positive), or the scan is "
            "mirrored: its scanner hangs upside down, and tf must say so (roll pi).",
        )  # fmt: skip
    elif abs(fit.scale - 1.0) > max(MAX_SCALE_ERROR, SURE * fit.scale_error):
        findings.warn(
            "yaw_scale", where,
            f"the scans turn {fit.scale:.2f} times what {source} says",
            "Correct the track width, or the gyro's scale, in the driver.",
        )  # fmt: skip
    _check_delay(fit, result, where, findings)


def _check_distances(result, where, findings):
    fit, source = result.distances, result.signal.source
    if fit is None:
        return
    if fit.scale < -0.3:
        findings.error(
            "speed_sign", where,
            f"{source} goes forward where the scans go backward (scale {fit.scale:.2f})",
            "Either the speed has the wrong sign, or the scanner looks backward, and tf or mounts "
            "must say so (yaw pi).",
        )  # fmt: skip
    elif abs(fit.scale - 1.0) > max(MAX_SCALE_ERROR, SURE * fit.scale_error):
        findings.warn(
            "odometry_scale", where,
            f"the scans move {fit.scale:.2f} times as far as {source} says",
            f"Multiply the wheel radius of the odometry's driver by {fit.scale:.2f}.",
        )  # fmt: skip
    # Turns show the delay better: a wrong mount does not change them.
    if result.turns is None:
        _check_delay(fit, result, where, findings)


def _check_delay(fit, result, where, findings):
    if abs(fit.delay) > MAX_DELAY and fit.gain > MIN_GAIN:
        findings.warn(
            "clock_offset", where,
            f"{result.signal.source} is {abs(fit.delay):.2f} s "
            f"{'later' if fit.delay > 0 else 'earlier'} than the scans, by the motion of both",
            "Synchronize the clocks, or correct the stamps of the one that is off: at 1 rad/s "
            f"the scans are turned by {math.degrees(abs(fit.delay)):.0f} degrees.",
        )  # fmt: skip


def _is_dead(signal):
    speeds = signal.speeds()
    return np.ptp(signal.headings) < 1e-6 and (not len(speeds) or speeds.max() < 1e-6)


def _check_pose_against_twist(results, roles, findings):
    pose, twist = results.get("pose"), results.get("twist_of_odometry")
    if pose is None or twist is None:
        return
    if _is_dead(twist.signal) and not _is_dead(pose.signal):
        findings.note(
            "no_twist", roles.odometry, "its poses move, and its twist is always 0",
            "The yaml takes the motion from the poses (motion/odometry_pose).",
        )  # fmt: skip
        return
    distance = [np.sum(r.signal.speeds()) * 0.1 for r in (pose, twist)]
    if min(distance) > 1.0 and not 0.8 < distance[1] / distance[0] < 1.25:
        findings.warn(
            "twist_against_pose", roles.odometry,
            f"by its poses the vehicle goes {distance[0]:.1f} m, by its twist {distance[1]:.1f} m",
            "One of them is wrong; the yaml takes the one that fits the scans better.",
        )  # fmt: skip


def check_mount_yaw(result, motions, mount, roles, findings):
    """Adds where the scanner looks in another direction than its mount says, by where it moves to."""
    if result is None or result.signal.positions is None or mount is None:
        return
    starts, ends = motions.starts, motions.ends
    usable = motions.certain & result.signal.covers(starts, ends)
    said = _scanner_shifts(result.signal, starts[usable], ends[usable], mount)
    seen = motions.motions[usable, :2]
    far = (np.hypot(*said.T) > MIN_SHIFT) & (np.hypot(*seen.T) > MIN_SHIFT)
    if far.sum() < MIN_MOUNT_PAIRS:
        return
    angles = np.arctan2(said[far, 1], said[far, 0]) - np.arctan2(seen[far, 1], seen[far, 0])
    angles = angles - mount[2]
    off = float(np.angle(np.median(np.cos(angles)) + 1j * np.median(np.sin(angles))))
    spread = float(np.median(np.abs(np.angle(np.exp(1j * (angles - off))))))
    # Half a turn is a speed of the wrong sign as well, which is said elsewhere.
    is_sign = abs(off) > math.pi - 0.3
    if not is_sign and abs(off) > max(MAX_MOUNT_YAW, SURE * spread / math.sqrt(far.sum())):
        findings.warn(
            "mount_yaw", roles.scan,
            f"as the vehicle moves, the scans say that the scanner looks "
            f"{math.degrees(off):+.0f} degrees from where tf or mounts have it",
            f"Its yaw on {roles.base_frame} should be {mount[2] + off:.2f} rad.",
        )  # fmt: skip


def _scanner_shifts(signal, starts, ends, mount):
    """n x 2, m: how the scanner moves by a signal of the vehicle, along the vehicle's axes."""
    turns = signal.turns(starts, ends)
    cosine, sine = np.cos(turns) - 1.0, np.sin(turns)
    x, y = mount[:2]
    return signal.motions(starts, ends) + np.column_stack([cosine * x - sine * y,
                                                           sine * x + cosine * y])  # fmt: skip
