"""Sizes and noises of the stages from what the scanner reaches and how fast the vehicle is."""

import math
from typing import NamedTuple, Optional

# What the stages have by default: a car in a street.
DEFAULT_LENGTH, DEFAULT_WIDTH, DEFAULT_CELL = 90.0, 108.0, 0.3  # m
DEFAULT_FREE_RANGE = 40.0  # m
DEFAULT_RANGE_NOISE = 0.1  # m

SMALL_REACH = 20.0  # m: a scanner that reaches less is of a robot, indoors or of a model's size
SMALL_SPEED = 3.0  # m/s: nothing that drives among people is faster
FIT_RATIO = 0.45, 3.0  # of the default window's half length, within which a reach fits


class Measured(NamedTuple):
    """What the recording says of scanner and vehicle."""

    reach: float  # m
    spacing: float  # rad
    noise: Optional[float]  # m; None: not measured, the vehicle never stands
    free_range: float  # m; 0: a beam without return says nothing
    speed: Optional[float]  # m/s, 95 %; None: not known


def is_small(measured):
    """Whether the sizes are those of a robot among people and not of a car among cars."""
    slow = measured.speed is None or measured.speed < SMALL_SPEED
    return measured.reach < SMALL_REACH and slow


def check_reach(measured, roles, findings):
    """Adds where the default window does not fit the scanner."""
    half = 0.5 * DEFAULT_LENGTH
    ratio = measured.reach / half
    if ratio < FIT_RATIO[0]:
        findings.warn(
            "reach_below_window", roles.scan,
            f"the scanner sees up to {measured.reach:.1f} m (98 % of its returns), and the default "
            f"window reaches {half:.0f} m in cells of {DEFAULT_CELL} m: sizes made for cars",
            "Use the yaml that is written here: its window, cells and sizes are the scanner's.",
        )  # fmt: skip
    elif ratio > FIT_RATIO[1]:
        findings.warn(
            "reach_beyond_window", roles.scan,
            f"the scanner sees up to {measured.reach:.1f} m, and the default window ends at "
            f"{half:.0f} m",
            "What lies beyond is not used. The yaml has a larger window, which costs time.",
        )  # fmt: skip
    if measured.free_range == 0.0:
        findings.note(
            "lost_returns", roles.scan,
            "beams between others that return come back from nothing even nearby",
            "The yaml says free_range 0: a beam without return clears nothing.",
        )  # fmt: skip


def window(measured):
    """Length (m) and cell size (m) of the square window for the scanner."""
    if FIT_RATIO[0] <= measured.reach / (0.5 * DEFAULT_LENGTH) <= 1.2:
        return None
    length = (3.0 if measured.reach < SMALL_REACH else 2.2) * measured.reach
    cell = min(max(0.05 * round(0.2 * measured.reach), 0.1), DEFAULT_CELL)
    return 2.0 * math.ceil(0.5 * length), round(cell, 2)


def settings(measured):
    """Sections (nested dictionaries) of the yaml that differ from the defaults."""
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
    # Whole meters below, for the last one may be seen at a good angle only.
    value = float(math.floor(min(measured.free_range, measured.reach)))
    if abs(value - DEFAULT_FREE_RANGE) >= 1.0:
        _at(sections, "lidar_grid", "scan")["free_range"] = value
        _at(sections, "grid_slam", "scan")["free_range"] = value


def _set_noise(sections, measured):
    if measured.noise is None:
        return
    noise = max(round(measured.noise, 3), 0.01)
    _at(sections, "grid_slam", "matcher")["point_sigma"] = max(noise, 0.02)
    _at(sections, "grid_slam", "map")["surface_sigma"] = max(noise, 0.02)
    _at(sections, "moving_objects")["range_sigma"] = noise


def _set_small(sections, measured):
    speed = measured.speed if measured.speed else 1.0
    slam = _at(sections, "grid_slam")
    slam["longest_step"] = 0.5
    slam["motion"] = {
        "yaw_rate_noise": 0.05,
        "yaw_rate_noise_ratio": 0.3,
        "acceleration_noise": 1.0,
        "initial_speed_sigma": round(max(speed, 0.5), 1),
        "initial_yaw_rate_sigma": 0.5,
    }
    _at(sections, "moving_objects").update(largest_size=3.0)
    _at(sections, "moving_objects")["segmentation"] = {"longest_gap": 0.6, "shortest_gap": 0.2}
