# SPDX-License-Identifier: BSD-3-Clause
"""Runs all checks in order, and holds their result."""

from typing import NamedTuple

import numpy as np

from datmo_tools.check_bag import configuration, levels, motion_checks
from datmo_tools.check_bag.camera_checks import check_cameras
from datmo_tools.check_bag.findings import Findings, Severity
from datmo_tools.check_bag.frame_checks import check_frames, scanner_mount
from datmo_tools.check_bag.motion_signal import planar_mount
from datmo_tools.check_bag.noise import STILL_SHIFT, STILL_TURN, free_range, range_noise
from datmo_tools.check_bag.presence import check_presence
from datmo_tools.check_bag.roles import Roles
from datmo_tools.check_bag.scan_checks import check_scans
from datmo_tools.check_bag.scan_motion import in_base, scan_motions
from datmo_tools.check_bag.sizing import Measured, check_reach
from datmo_tools.check_bag.timing import check_timing
from datmo_tools.check_bag.yaml_text import yaml_text
from datmo_tools.errors import InputError


class Result(NamedTuple):
    """Everything that is known about a recording."""

    recording: object
    roles: Roles
    findings: Findings
    levels: list
    facts: object  # ScannerFacts or None
    measured: object  # Measured or None
    mount: object  # 4 x 4 or None
    results: dict  # role -> MotionResult

    @property
    def can_start(self):
        """Whether the stack can run on the recording at all."""
        return self.facts is not None

    def yaml_text(self):
        """Returns the text of the initial yaml."""
        sections, remarks = configuration.sections(
            self.recording, self.roles, self.results, self.measured
        )
        return yaml_text(self.recording.path.name, sections, remarks)

    def start_lines(self, bag, config):
        """Returns the shell commands to start with, for the highest level whose inputs exist."""
        ready = [level for level in self.levels[:4] if not level.missing]
        best = next((level for level in ready if "object" in level.name), self.levels[0])
        return configuration.start_lines(bag, config, self.roles, self.recording, best)

    def as_dictionary(self):
        """Returns the findings, for JSON."""
        return {
            "findings": [
                {**item._asdict(), "severity": Severity(item.severity).name.lower()}
                for item in self.findings.sorted()
            ],
            "levels": {level.name: list(level.missing) for level in self.levels},
        }


def check(recording, scan=None, odometry=None):
    """Returns the Result of a Recording; scan, odometry: topics to use, by default the best ones.

    Raises InputError if the recording does not have these topics.
    """
    _check_topic(scan, recording.scans, "LaserScan or MultiEchoLaserScan")
    _check_topic(odometry, recording.odometry, "Odometry")
    findings = Findings()
    roles = Roles(recording, scan, odometry)
    check_presence(recording, roles, findings)
    check_timing(recording, roles, findings)
    check_frames(recording, roles, findings)
    check_cameras(recording, roles, findings)
    signals = motion_checks.motion_signals(recording, roles)
    facts = check_scans(recording, roles, findings, motion_checks.vehicle_moved(signals))
    mount = scanner_mount(recording, roles) if roles.scan else None
    results, measured = {}, None
    if facts is not None:
        results = _compare_motion(recording, roles, signals, facts, mount, findings)
        measured = _measure(recording, roles, signals, facts)
        check_reach(measured, roles, findings)
    return Result(
        recording, roles, findings, levels.levels(recording, roles), facts, measured, mount, results
    )


def _check_topic(name, known, types):
    if name is not None and name not in known:
        there = ", ".join(sorted(known)) or "none"
        raise InputError(f"{name}: no {types} in the recording, which has {there}")


def _compare_motion(recording, roles, signals, facts, mount, findings):
    scans = [
        scan._replace(angle_min=-scan.angle_min, angle_increment=-scan.angle_increment)
        if mount is not None and planar_mount(mount)[1] else scan
        for scan in recording.scans[roles.scan]
    ]  # fmt: skip
    motions = scan_motions(scans, facts, list(signals.values()))
    planar = planar_mount(mount)[0] if mount is not None else None
    in_vehicle = in_base(motions.motions, planar if planar is not None else np.zeros(3))
    results = motion_checks.compare(signals, motions, in_vehicle)
    motion_checks.check_motion(results, roles, findings)
    best = results.get("pose") or results.get("twist")
    motion_checks.check_mount_yaw(best, motions, planar, roles, findings)
    return results


def _measure(recording, roles, signals, facts):
    scans = recording.scans[roles.scan]
    return Measured(
        facts.reach, facts.spacing, range_noise(scans, _stillness(signals)),
        free_range(scans, facts), _speed(signals),
    )  # fmt: skip


def _stillness(signals):
    """Returns a function of two stamps: whether no signal moves between them (none: False)."""

    def still(start, end):
        if not signals:
            return False
        times = np.array([start]), np.array([end])
        for signal in signals.values():
            if not signal.covers(*times)[0]:
                return False
            if signal.headings is not None and abs(signal.turns(*times)[0]) > STILL_TURN:
                return False
            if signal.positions is not None and signal.headings is not None:
                if np.hypot(*signal.motions(*times)[0]) > STILL_SHIFT:
                    return False
        return True

    return still


def _speed(signals):
    for name in ("pose", "twist_of_odometry", "twist"):
        speeds = signals[name].speeds() if name in signals else np.zeros(0)
        if len(speeds) and speeds.max() > 0.01:
            return float(np.percentile(speeds, 95))
    return None
