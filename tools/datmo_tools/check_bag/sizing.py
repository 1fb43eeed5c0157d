# SPDX-License-Identifier: BSD-3-Clause
"""Chooses sizes and noises of the stages from the scanner's range and the vehicle's speed."""

import copy
import math
from typing import NamedTuple, Optional

# Defaults of the stages: a car in a street.
DEFAULT_LENGTH, DEFAULT_WIDTH, DEFAULT_CELL = 90.0, 108.0, 0.3  # m
DEFAULT_FREE_RANGE = 40.0  # m
MIN_NOISE = 0.02  # m: surfaces are rough, and scans take time
DEFAULT_RANGE_NOISE = 0.1  # m

SMALL_REACH = 20.0  # m: a scanner with a shorter range is on a robot, indoors or of a model's size
SMALL_SPEED = 3.0  # m/s: no vehicle among people is faster
FIT_RATIO = 0.45, 3.0  # of the default window's half length, within which a range fits

MIN_INITIAL_SPEED = 0.5  # m/s
STATIC_AFTER = 2.0  # s: people stop for a moment, and are not a wall because of that
ROBOT_ODOMETRY = {
    "yaw_rate_noise": 0.05,  # rad/s
    "yaw_rate_noise_ratio": 0.3,  # wheels slip when they turn in place
}
ROBOT_MOTION = {
    "acceleration_noise": 1.0,  # m/s^1.5
    "initial_yaw_rate_sigma": 0.5,  # rad/s
}

# People as seen by a low scanner: one or two legs, 0.1 m to 0.5 m, that swing by about 0.15 m about
# the body. A standing person is tracked, too, so nothing has to be seen moving first.
PEOPLE_OBJECTS = {
    "max_size": 3.0,  # m
    "position_sigma": 0.15,  # m
    "segmentation": {"max_gap": 0.6, "min_gap": 0.2},  # m
}
PEOPLE_TRACKER = {
    "require_motion": False,
    "intake": {"new_density": 0.01},  # 1/m^2
    "split_merge": {"margin": 0.2},  # m
    "visibility": {"blocking_distance": 0.2},  # m
    "target": {
        "birth_speed_std": 1.5,  # m/s: people walk
        "stop_speed": 0.2,  # m/s
        "motion_likelihood": {"free_path": 0.4},  # m: a robot passes close to walls
        "box": {
            "size": {
                "vehicle": {"share": 1e-4},
                "lorry": {"share": 1e-5},
                "two_wheeler": {"share": 1e-3},
                "person": {"share": 0.9, "length": 0.4, "length_std": 0.15,
                           "width": 0.3, "width_std": 0.15},
                "other": {"share": 0.1, "length": 0.8, "length_std": 0.6,
                          "width": 0.6, "width_std": 0.4},
            },
        },
    },
    "max_position_std": 1.0,  # m
}  # fmt: skip


class Measured(NamedTuple):
    """Properties of scanner and vehicle, from the recording."""

    reach: float  # m
    spacing: float  # rad
    noise: Optional[float]  # m; None: not measured, the vehicle never stands
    free_range: float  # m; 0: a beam without return carries no information
    speed: Optional[float]  # m/s, 95th percentile; None: not known


def is_small(measured):
    """Whether the sizes are those of a robot among people instead of a car among cars."""
    slow = measured.speed is None or measured.speed < SMALL_SPEED
    return measured.reach < SMALL_REACH and slow


def check_reach(measured, roles, findings):
    """Adds findings where the default window does not fit the scanner."""
    half = 0.5 * DEFAULT_LENGTH
    ratio = measured.reach / half
    if ratio < FIT_RATIO[0]:
        findings.warn(
            "reach_below_window", roles.scan,
            f"the scanner's range is {measured.reach:.1f} m (98 % of its returns), but the default "
            f"window reaches {half:.0f} m in cells of {DEFAULT_CELL} m: sizes for cars",
            "Use the yaml written here: its window, cells and sizes fit the scanner.",
        )  # fmt: skip
    elif ratio > FIT_RATIO[1]:
        findings.warn(
            "reach_beyond_window", roles.scan,
            f"the scanner's range is {measured.reach:.1f} m, but the default window ends at "
            f"{half:.0f} m",
            "Returns beyond it are not used. The yaml has a larger window, which costs time.",
        )  # fmt: skip
    if measured.free_range == 0.0:
        findings.note(
            "lost_returns", roles.scan,
            "many beams between others that return do not return, even nearby",
            "The yaml sets free_range to 0: a beam without return clears no cells.",
        )  # fmt: skip


def window(measured):
    """Returns length (m) and cell size (m) of the square window for the scanner."""
    if FIT_RATIO[0] <= measured.reach / (0.5 * DEFAULT_LENGTH) <= 1.2:
        return None
    length = (3.0 if measured.reach < SMALL_REACH else 2.2) * measured.reach
    cell = min(max(0.05 * round(0.2 * measured.reach), 0.1), DEFAULT_CELL)
    return 2.0 * math.ceil(0.5 * length), round(cell, 2)


def settings(measured):
    """Returns the sections (nested dictionaries) of the yaml that differ from the defaults."""
    sections = {}
    _set_free_range(sections, measured)
    _set_noise(sections, measured)
    shape = window(measured)
    if shape is not None:
        length, cell = shape
        grid = {"length": length, "width": length, "cell_size": cell}
        _at(sections, "lidar_grid")["window"] = dict(grid)
        _at(sections, "grid_slam", "map").update(grid)
    if is_small(measured):
        _set_small(sections, measured)
    return sections


def _at(sections, *path):
    for name in path:
        sections = sections.setdefault(name, {})
    return sections


def _set_free_range(sections, measured):
    # Rounded down to whole meters, as the last one may be seen only at a good angle.
    value = float(math.floor(min(measured.free_range, measured.reach)))
    if abs(value - DEFAULT_FREE_RANGE) >= 1.0:
        _at(sections, "scanner")["free_range"] = value


def _set_noise(sections, measured):
    if measured.noise is None:
        return
    noise = max(round(measured.noise, 3), MIN_NOISE)
    _at(sections, "scanner")["range_sigma"] = noise
    _at(sections, "grid_slam", "map")["surface_sigma"] = noise


def _set_small(sections, measured):
    speed = max(measured.speed or 0.0, MIN_INITIAL_SPEED)
    slam = _at(sections, "grid_slam")
    slam["max_step"] = 0.5
    _at(slam, "map")["static_after"] = STATIC_AFTER
    _at(sections, "motion").update(ROBOT_ODOMETRY)
    slam["motion"] = {**ROBOT_MOTION, "initial_speed_sigma": round(speed, 1)}
    _at(sections, "moving_objects").update(copy.deepcopy(PEOPLE_OBJECTS))
    tracker = _at(sections, "tracker")
    tracker.update(copy.deepcopy(PEOPLE_TRACKER))
    tracker["clutter"] = {"cell_size": 2.0, "range": float(math.ceil(measured.reach))}
