# SPDX-License-Identifier: BSD-3-Clause
"""Scores how the pose passes a gap of its inputs, and whether its covariance is honest."""

import math
from typing import NamedTuple

import numpy as np

from datmo_tools import transforms
from datmo_tools.pose_path import POSE_OF, planar, read_messages, read_path
from datmo_tools.stamps import NANOSECONDS
from datmo_tools.text_table import aligned

# The final pose may be off by a fixed part, and a share of the distance since the gap began.
POSITION_LIMIT = 0.5  # m
POSITION_SHARE = 0.01
HEADING_LIMIT = math.radians(2.0)
# A gap in which the vehicle is carried elsewhere: its pose need not be found again.
CARRIED = "carried"
# An error beyond the limit is not admitted by the pose if it is more than this many sigma.
SIGMAS = 3.0


class Gap(NamedTuple):
    """A time span without messages."""

    kind: str  # what is missing: "scan", "odometry" or "both"; or CARRIED
    begin: int  # ns
    seconds: float

    @property
    def end(self):
        """ns"""
        return self.begin + round(self.seconds * NANOSECONDS)


def score(computed, recorded, gap, topic="/pose/local", truth_topic="/ground_truth/pose"):
    """Returns the score (dict) of the poses in the bag `computed` (Path) after a gap.

    recorded: bag (Path) with the truth. Both paths are compared by their motion since the last pose
    before the gap, so that earlier errors of the map do not count, and by the covariance in the
    map as it is. Raises InputError.
    """
    truth = read_path(recorded, truth_topic)
    poses = _poses(computed, topic)
    before = [pose for pose in poses if pose[0] <= gap.begin]
    after = [pose for pose in poses if pose[0] > gap.begin]
    if not before or not after:
        return {"scans": len(after), "without_pose": True}
    start = before[-1]
    checks = [_check(start, pose, truth) for pose in after]
    return {
        "scans": len(checks),
        "without_pose": False,
        "may_stay_unknown": gap.kind == CARRIED,
        "end": checks[-1],
        "confident_wrong": sum(check["beyond"] and not check["admitted"] for check in checks),
        **({} if gap.kind == CARRIED else _motion(truth, gap)),
    }


def passed(result):
    """Whether a run ended within the limits, and was never overconfident."""
    if result["without_pose"] or result["confident_wrong"]:
        return False
    return result["may_stay_unknown"] or not result["end"]["beyond"]


def table(runs):
    """Returns a text: a row for each kind and length of gap, and totals."""
    rows = [["gap", "s", "runs", "ended off", "admitted", "confident and wrong: runs", "scans",
             "worst end, m", "deg"]]  # fmt: skip
    keys = sorted({(run["kind"], run["seconds"]) for run in runs})
    for key in keys:
        rows.append([key[0], f"{key[1]:g}", *_row([r for r in runs if _key(r) == key])])
    rows.append(["all", "", *_row(runs)])
    return aligned(rows)


def _key(run):
    return (run["kind"], run["seconds"])


def _row(runs):
    scored = [run["score"] for run in runs if not run["score"]["without_pose"]]
    ends = [score["end"] for score in scored]
    off = [end for end in ends if end["beyond"]]
    wrong = [score for score in scored if score["confident_wrong"]]
    return [
        str(len(runs)),
        str(len(off) + len(runs) - len(scored)),
        str(sum(end["admitted"] for end in off)),
        str(len(wrong)),
        str(sum(score["confident_wrong"] for score in wrong)),
        f"{max((end['position_m'] for end in ends), default=math.nan):.2f}",
        f"{max((end['heading_deg'] for end in ends), default=math.nan):.1f}",
    ]


def _check(start, pose, truth):
    """Compares one pose after the gap with the truth; returns a dictionary."""
    start_stamp, start_pose, _ = start
    stamp, estimate, covariance = pose
    true_motion = transforms.relative(truth.at(start_stamp), truth.at(stamp))
    expected = np.asarray(transforms.compose(start_pose, true_motion))
    error = np.asarray(estimate) - expected
    distance = float(np.hypot(*error[:2]))
    heading = abs(math.remainder(error[2], 2.0 * math.pi))
    covered = truth.length_between(start_stamp, stamp)
    far = distance > POSITION_LIMIT + POSITION_SHARE * covered
    turned = heading > HEADING_LIMIT
    sigma = _sigma_along(covariance[:2, :2], error[:2])
    heading_sigma = math.sqrt(max(0.0, covariance[2, 2]))
    return {
        "position_m": distance,
        "heading_deg": math.degrees(heading),
        "distance_m": covered,
        "sigma_m": sigma,
        "sigma_deg": math.degrees(heading_sigma),
        "beyond": bool(far or turned),
        "admitted": bool((not far or distance <= SIGMAS * sigma)
                         and (not turned or heading <= SIGMAS * heading_sigma)),
    }  # fmt: skip


def _sigma_along(covariance, direction):
    length = float(np.hypot(*direction))
    if length == 0.0:
        return 0.0
    unit = direction / length
    return math.sqrt(max(0.0, float(unit @ covariance @ unit)))


def _motion(truth, gap):
    """Returns the vehicle's mean speed and its turn during a gap (dict)."""
    return {"speed_mps": _speed(truth, gap), "turn_deg": _turn(truth, gap)}


def _speed(truth, gap):
    seconds = max(gap.seconds, 0.1)
    motion = transforms.relative(
        truth.at(gap.begin), truth.at(gap.begin + round(seconds * NANOSECONDS))
    )
    return float(np.hypot(*motion[:2])) / seconds


def _turn(truth, gap):
    """Returns the turn from the gap's begin to its end, degrees."""
    return math.degrees(abs(transforms.relative(truth.at(gap.begin), truth.at(gap.end))[2]))


def _poses(bag, topic):
    """Returns a list of (stamp in ns, pose, covariance over x, y and yaw) on a topic, by stamp."""
    poses = []
    for message, kind in read_messages(bag, topic):
        covariance = np.reshape(message.pose.covariance, (6, 6))[np.ix_([0, 1, 5], [0, 1, 5])]
        poses.append((message.header.stamp.to_nsec(), planar(POSE_OF[kind](message)), covariance))
    return sorted(poses, key=lambda pose: pose[0])
