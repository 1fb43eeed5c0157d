# SPDX-License-Identifier: BSD-3-Clause
"""Compares odometry, IMU and twist with the motion estimated from the scans."""

import math
from typing import NamedTuple, Optional

import numpy as np

from datmo_tools.check_bag.motion_fit import MotionFit, fit_distances, fit_turns
from datmo_tools.check_bag.motion_signal import MotionSignal

MAX_SCALE_ERROR = 0.06  # of the scale, above which it is reported
SURE = 3.0  # standard deviations
MAX_DELAY = 0.06  # s
MIN_GAIN = 1.15  # ratio of the costs without and with a delay, for the delay to be reported
MAX_MOUNT_YAW = math.radians(4.0)
MIN_MOUNT_PAIRS = 20
MIN_SHIFT = 0.05  # m, above which a shift has a direction
STANDING_SPEED = 0.02  # m/s
STANDING_TURN = 0.01  # rad/s


class MotionResult(NamedTuple):
    """A signal and how it fits the scans."""

    signal: MotionSignal
    turns: Optional[MotionFit]
    distances: Optional[MotionFit]

    @property
    def misfit(self):
        """Residual between signal and scans, in units of the floor; inf: unknown."""
        fits = [(self.turns, 0.0015), (self.distances, 0.005)]
        parts = [
            fit.noise / floor * (1.0 + 10.0 * abs(abs(fit.scale) - 1.0))
            for fit, floor in fits if fit is not None
        ]  # fmt: skip
        return sum(parts) / len(parts) if parts else math.inf


def motion_signals(recording, roles):
    """Returns a dictionary role -> MotionSignal: pose and twist of the odometry, twist, imu."""
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
    """Whether any signal shows the vehicle moving for a while; True if there is none that could."""
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
    """Returns a dictionary role -> MotionResult."""
    return {
        name: MotionResult(
            signal,
            fit_turns(signal, motions),
            fit_distances(signal, motions, base_motions) if base_motions is not None else None,
        )
        for name, signal in signals.items()
    }


def check_motion(results, roles, findings):
    """Adds findings where odometry, twist and IMU disagree with the scans."""
    unused = _unused(results)
    for name, result in results.items():
        if name == unused:
            continue
        where = {"imu": roles.imu, "twist": roles.twist}.get(name, roles.odometry)
        _check_turns(result, where, findings)
        _check_distances(result, where, findings)
    _check_pose_against_twist(results, roles, findings)


def poses_are_better(results):
    """Whether the odometry's poses fit the scans better than its twist; None without odometry."""
    pose, twist = results.get("pose"), results.get("twist_of_odometry")
    if pose is None:
        return None
    if twist is None or (_is_dead(twist.signal) and not _is_dead(pose.signal)):
        return True
    return pose.misfit < 0.9 * twist.misfit


def _unused(results):
    """Returns the part of the odometry, pose or twist, that the yaml does not use."""
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
            "mirrored: the scanner is upside down, and tf must state that (roll pi).",
        )  # fmt: skip
    elif abs(fit.scale - 1.0) > max(MAX_SCALE_ERROR, SURE * fit.scale_error):
        findings.warn(
            "yaw_scale", where,
            f"the scans turn {fit.scale:.2f} times as much as {source}",
            "Correct the track width or the gyro's scale in the driver.",
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
            "Either the speed has the wrong sign, or the scanner faces backward, and tf or mounts "
            "must state that (yaw pi).",
        )  # fmt: skip
    elif abs(fit.scale - 1.0) > max(MAX_SCALE_ERROR, SURE * fit.scale_error):
        findings.warn(
            "odometry_scale", where,
            f"the scans move {fit.scale:.2f} times as far as {source}",
            f"Multiply the wheel radius in the odometry's driver by {fit.scale:.2f}.",
        )  # fmt: skip
    # Turning shows the delay better: a wrong mount does not change it.
    if result.turns is None:
        _check_delay(fit, result, where, findings)


def _check_delay(fit, result, where, findings):
    if abs(fit.delay) > MAX_DELAY and fit.gain > MIN_GAIN:
        findings.warn(
            "clock_offset", where,
            f"{result.signal.source} is {abs(fit.delay):.2f} s "
            f"{'later' if fit.delay > 0 else 'earlier'} than the scans, by the motion of both",
            "Synchronize the clocks, or correct the wrong stamps: at 1 rad/s "
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
            "no_twist", roles.odometry, "its poses move, but its twist is always 0",
            "The yaml takes the motion from the poses (motion/odometry_pose).",
        )  # fmt: skip
        return
    distance = [np.sum(r.signal.speeds()) * 0.1 for r in (pose, twist)]
    if min(distance) > 1.0 and not 0.8 < distance[1] / distance[0] < 1.25:
        findings.warn(
            "twist_against_pose", roles.odometry,
            f"the vehicle moves {distance[0]:.1f} m by its poses, {distance[1]:.1f} m by its twist",
            "One of them is wrong; the yaml uses the one that fits the scans better.",
        )  # fmt: skip


def check_mount_yaw(result, motions, mount, roles, findings):
    """Adds a finding if the scanner, by its motion, faces another way than its mount says."""
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
    # Half a turn is also a speed of the wrong sign, which is reported elsewhere.
    is_sign = abs(off) > math.pi - 0.3
    if not is_sign and abs(off) > max(MAX_MOUNT_YAW, SURE * spread / math.sqrt(far.sum())):
        findings.warn(
            "mount_yaw", roles.scan,
            f"judging by the motion, the scanner faces "
            f"{math.degrees(off):+.0f} degrees away from its mount in tf or the yaml",
            f"Its yaw on {roles.base_frame} should be {mount[2] + off:.2f} rad.",
        )  # fmt: skip


def _scanner_shifts(signal, starts, ends, mount):
    """Returns the scanner's motion (n x 2, m, in the vehicle's axes) by a signal of the vehicle."""
    turns = signal.turns(starts, ends)
    cosine, sine = np.cos(turns) - 1.0, np.sin(turns)
    x, y = mount[:2]
    return signal.motions(starts, ends) + np.column_stack([cosine * x - sine * y,
                                                           sine * x + cosine * y])  # fmt: skip
