# SPDX-License-Identifier: BSD-3-Clause
"""Command line of mocap_to_bag."""

import math
from pathlib import Path

import numpy as np

from datmo_tools import command_line
from datmo_tools.convert import mocap_bag
from datmo_tools.errors import InputError

DESCRIPTION = """\
Converts a recorded bag of a car with a 2D scanner, with the poses of it and of other cars measured
by motion capture, to a bag: /scan, /tf_static, /ground_truth/pose, /ground_truth/objects, and,
if wheel speeds and an IMU were recorded, /odometry and /tf. Run it with config/model_car.yaml;
without odometry, with motion: {source: none}.

base_link is the frame in which motion capture has the scanner's car, and map its first pose. The
defaults are for the example bags of the package datmo (1:10 cars, an RPLIDAR), measured there:
the last beam of a message is the first in time; the scans' clock is ahead of motion capture's by
15 ms (walls are sharpest so, to 3 ms); ranges are short, by 0.08 m at 4 m and 0.42 m at 5 m
(this makes walls agree, seen from near and far); and the origin of the markers is not the middle of
the body whose outline the scanner saw. When motion capture repeats a pose to the last bit, it has
lost the car, and there is no truth."""


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run(
        "mocap_to_bag", lambda: mocap_bag.convert(values.recording, values.bag, _options(values))
    )


def _parser():
    defaults = mocap_bag.Options()
    parser = command_line.new_parser("mocap_to_bag", DESCRIPTION)
    add = parser.add_argument
    add("recording", type=Path, help="recorded bag")
    add("bag", type=Path, help="bag to write")
    _add_topics(parser.add_argument_group("topics"), defaults)
    _add_odometry(parser.add_argument_group("odometry"), defaults)
    _add_scanner(parser.add_argument_group("scanner"), defaults)
    _add_truth(parser.add_argument_group("truth"), defaults)
    return parser


def _add_topics(group, defaults):
    scan = "sensor_msgs/LaserScan (default %(default)s)"
    group.add_argument("--scan", default=defaults.scan_topic, metavar="TOPIC", help=scan)
    ego = "motion capture of the scanner's car (default %(default)s)"
    group.add_argument("--ego-pose", default=defaults.ego_topic, metavar="TOPIC", help=ego)
    others = f"motion capture of the other cars (default {' '.join(defaults.object_topics)})"
    group.add_argument(
        "--object-pose",
        nargs="+",
        default=list(defaults.object_topics),
        metavar="TOPIC",
        help=others,
    )


def _add_odometry(group, defaults):
    wheels = "speeds FL, FR, BL, BR of the wheels, rad/s (default %(default)s)"
    group.add_argument(
        "--wheel-speeds", default=defaults.wheels_topic, metavar="TOPIC", help=wheels
    )
    imu = "sensor_msgs/Imu (default %(default)s)"
    group.add_argument("--imu", default=defaults.imu_topic, metavar="TOPIC", help=imu)
    command_line.add_number(group, "--wheel-radius", defaults.wheel_radius, "M", "m")
    group.add_argument("--no-odometry", action="store_true", help="write no odometry")


def _add_scanner(group, defaults):
    add = command_line.add_number
    mount = [*defaults.mount[:2].tolist(), math.degrees(defaults.mount[2])]
    add(group, "--mount", mount, ("X", "Y", "YAW"), "scanner in base_link, m, m, degrees")
    order = "beams are taken in the order of the message"
    group.add_argument("--beams-in-order", action="store_true", help=order)
    sweep = "s from the first beam to the last; 0: all at once (default: the time between scans)"
    group.add_argument("--sweep-time", type=command_line.number, metavar="S", help=sweep)
    delay = "s from a scan's stamp to its first beam, on the clock of motion capture"
    add(group, "--scan-delay", defaults.scan_delay, "S", delay)
    short = "by how much ranges R (m) are short: E (m), linear between; 0:0 for no correction"
    group.add_argument(
        "--range-errors",
        nargs="+",
        type=_range_error,
        default=list(defaults.range_errors),
        metavar="R:E",
        help=f"{short} (default {' '.join(f'{at:g}:{by:g}' for at, by in defaults.range_errors)})",
    )


def _add_truth(group, defaults):
    add = command_line.add_number
    add(group, "--object-size", list(defaults.object_size), ("L", "W", "H"), "of the other cars, m")
    center = "center of their body in the frame of the markers: m, m, degrees"
    turned = [*defaults.object_center[:2].tolist(), math.degrees(defaults.object_center[2])]
    add(group, "--object-center", turned, ("X", "Y", "YAW"), center)
    add(group, "--moving-speed", defaults.moving_speed, "V", "m/s; slower objects are stationary")


def _options(values):
    if values.sweep_time is not None and not 0.0 <= values.sweep_time <= 1.0:
        raise InputError(f"--sweep-time is {values.sweep_time}, expected 0 to 1 s")
    if abs(values.scan_delay) > 1.0:
        raise InputError(f"--scan-delay is {values.scan_delay}, expected -1 to 1 s")
    longer = [at + by for at, by in values.range_errors]
    if sorted(set(values.range_errors)) != values.range_errors or sorted(set(longer)) != longer:
        raise InputError(f"--range-errors are {values.range_errors}, expected rising R and R + E")
    if min(values.object_size) <= 0.0:
        raise InputError(f"--object-size is {values.object_size}, expected lengths above 0 m")
    command_line.check_positive(values, "wheel_radius", "moving_speed")
    return mocap_bag.Options(
        scan_topic=values.scan,
        ego_topic=values.ego_pose,
        object_topics=tuple(values.object_pose),
        wheels_topic=values.wheel_speeds,
        imu_topic=values.imu,
        odometry=not values.no_odometry,
        wheel_radius=values.wheel_radius,
        mount=_pose(values.mount),
        clockwise=not values.beams_in_order,
        sweep_time=values.sweep_time,
        scan_delay=values.scan_delay,
        range_errors=tuple(values.range_errors),
        object_size=tuple(values.object_size),
        object_center=_pose(values.object_center),
        moving_speed=values.moving_speed,
    )


def _range_error(text):
    """Parses R:E, two numbers; otherwise argparse reports the option."""
    at, _, by = text.partition(":")
    return command_line.number(at), command_line.number(by)


def _pose(numbers):
    return np.array([*numbers[:2], math.radians(numbers[2])])
