# SPDX-License-Identifier: BSD-3-Clause
"""Reads grids: those of a run, and the drive that the run was made from."""

import math
from typing import NamedTuple

import numpy as np
from nav_msgs.msg import OccupancyGrid

from datmo_tools import transforms
from datmo_tools.bag_input import opened
from datmo_tools.bag_messages import BASE
from datmo_tools.errors import InputError
from datmo_tools.evaluate.grid_scores import Bodies, Echoes, Grid, StereoView
from datmo_tools.evaluate.truth import TRUE_OBJECTS, TRUE_POSE, read_true_objects
from datmo_tools.pose_path import planar, read_path

SCANS = ("/echoes", "/scan")
TRUE_ECHOES = "/ground_truth/echoes"
CAMERA_INFOS = ("/stereo/left/camera_info", "/stereo/right/camera_info")
MOUNTS = "/tf_static"
POSE = "/pose"  # of the run

# As the simulator names them.
STEREO, POLE = "stereo", "Pole"


class Moment(NamedTuple):
    """The truth at the stamp of a scan."""

    echoes: Echoes
    bodies: Bodies
    poles: np.ndarray  # n x 2, base_link, m: thin ones that the camera sees


class Drive(NamedTuple):
    """A recording of the sensors with ground truth."""

    view: StereoView
    moments: dict  # stamp (ns) -> Moment


def read_topics(path, topics):
    """Returns a dictionary topic -> its messages; of CAMERA_INFOS only the last one, of a bag."""
    kept = {topic: [] for topic in topics}
    infos = {}
    with opened(path) as bag:
        for topic, message, _ in bag.read_messages([*kept, *CAMERA_INFOS]):
            if topic in kept:
                kept[topic].append(message)
            else:
                infos[topic] = message
    return kept, infos


def read_drive(path, reach, disparity_sigma):
    """Returns the Drive in the bag at `path` (Path).

    reach: effective range of the camera, m; disparity_sigma: standard deviation, px. A scan without
    truth has no Moment. Raises InputError if there is none at all, or no camera.
    """
    kept, infos = read_topics(path, (MOUNTS, TRUE_POSE, TRUE_ECHOES, *SCANS))
    mounts = mounts_of(kept[MOUNTS])
    view = view_of(path, infos, mounts, reach, disparity_sigma)
    moments = _moments(path, kept, mounts)
    if not moments:
        raise InputError(
            f"{path}: no scan with {TRUE_ECHOES}, {TRUE_OBJECTS} and {TRUE_POSE} of its stamp, "
            "expected a drive of 'simulate SCENE DRIVE --set stereo/enabled=true --set "
            "ground_truth/echoes=true'"
        )
    return Drive(view, moments)


def grid_pairs(path, first_topic, second_topic):
    """Yields (stamp, Grid, Grid) for each stamp (ns) with a grid on both topics of the bag.

    Raises InputError for another type, and for grids of one stamp with different windows.
    """
    waiting = {}
    with opened(path) as bag:
        for topic, raw, _ in bag.read_messages([first_topic, second_topic], raw=True):
            stamp, grid = grid_of(path, topic, raw)
            other_topic, other = waiting.get(stamp, (topic, None))
            if other_topic == topic:
                waiting[stamp] = (topic, grid)
                continue
            pair = (other, grid) if topic == second_topic else (grid, other)
            _check_same_window(path, stamp, *pair)
            yield (stamp, *pair)
            # Grids are published in order of their stamps: older ones will not find a partner.
            waiting = {late: kept for late, kept in waiting.items() if late > stamp}


def base_grids(path, topic):
    """Yields stamp (ns) and Grid in base_link of each grid on `topic` of a run's bag; maps are
    transformed by the run's pose. Raises InputError for another type."""
    poses = None
    for stamp, frame, grid in grid_messages(path, topic):
        if frame != BASE:
            poses = poses or read_path(path, POSE)
            grid = seen_from(grid, poses.at(stamp))
        yield stamp, grid


def grid_messages(path, topic):
    """Yields stamp (ns), frame and Grid of each grid on `topic`. Raises InputError for another
    type."""
    with opened(path) as bag:
        for name, raw, _ in bag.read_messages([topic], raw=True):
            yield _grid_message(path, name, raw)


def seen_from(grid, base):
    """Returns the Grid of a map as seen from a pose (x, y, yaw) in it: square, centered on the
    vehicle, with cells of the same size, each with the map's value at its center."""
    side = max(grid.cells.shape)
    origin = np.full(2, -0.5 * side * grid.cell_size)
    seen = Grid(grid.cell_size, origin, np.full((side, side), -1, dtype=np.int8))
    rows, columns = np.indices(seen.cells.shape)
    centers = seen.centers(np.column_stack([columns.ravel(), rows.ravel()]))
    in_map = transforms.points_in_parent(base, centers)
    found = np.floor((in_map - grid.origin) / grid.cell_size).astype(int)
    inside = np.all((found >= 0) & (found < grid.cells.shape[::-1]), axis=1)
    seen.cells.ravel()[inside] = grid.cells[found[inside, 1], found[inside, 0]]
    return seen


def grid_of(path, topic, raw):
    """Stamp and Grid of a message as stored in the bag: a grid has 100,000 cells and more."""
    stamp, _, grid = _grid_message(path, topic, raw)
    return stamp, grid


def _grid_message(path, topic, raw):
    kind, data = raw[0], raw[1]
    if kind != "nav_msgs/OccupancyGrid":
        raise InputError(f"{path}: {topic} is {kind}, expected nav_msgs/OccupancyGrid")
    message = OccupancyGrid().deserialize_numpy(data, np)
    info = message.info
    cells = np.asarray(message.data, dtype=np.int8).reshape(info.height, info.width)
    origin = np.array([info.origin.position.x, info.origin.position.y])
    grid = Grid(info.resolution, origin, cells)
    return message.header.stamp.to_nsec(), message.header.frame_id, grid


def _check_same_window(path, stamp, first, second):
    same = first.cells.shape == second.cells.shape and first.cell_size == second.cell_size
    if not (same and np.allclose(first.origin, second.origin)):
        raise InputError(
            f"{path}: grids of {stamp * 1e-9:.6f} s have {first.cells.shape} cells of "
            f"{first.cell_size:g} m and {second.cells.shape} of {second.cell_size:g} m, expected "
            "the same window"
        )


def mounts_of(messages):
    """Returns a dictionary frame -> 4 x 4 transform in base_link."""
    return {
        item.child_frame_id: transforms.rigid_of(item.transform)
        for message in messages
        for item in message.transforms
        if item.header.frame_id == BASE
    }


def mount_of(path, mounts, frame):
    """Returns the mount of one sensor (4 x 4). Raises InputError if it is missing."""
    if frame not in mounts:
        raise InputError(f"{path}: {MOUNTS} has no {BASE} -> {frame}, expected the sensor's mount")
    return mounts[frame]


def view_of(path, infos, mounts, reach, disparity_sigma):
    """Returns the StereoView of the camera; infos: dictionary topic -> CameraInfo, of CAMERA_INFOS.

    Raises InputError if one is missing or not of a stereo camera.
    """
    for topic in CAMERA_INFOS:
        if topic not in infos:
            raise InputError(f"{path}: nothing on {topic}, expected a drive with a stereo camera")
    left, right = (infos[topic] for topic in CAMERA_INFOS)
    focal, middle, baseline_term = left.P[0], left.P[2], -right.P[3]
    if not (focal > 0.0 and baseline_term > 0.0):
        raise InputError(
            f"{path}: {CAMERA_INFOS[1]} has P[0] = {focal:g} and P[3] = {right.P[3]:g}, expected "
            "the focal length and minus its product with the baseline"
        )
    tangents = (-middle / focal, (left.width - 1 - middle) / focal)
    camera = mount_of(path, mounts, left.header.frame_id)
    return StereoView(camera, tangents, reach, disparity_sigma / baseline_term)


def _moments(path, kept, mounts):
    poses = {message.header.stamp.to_nsec(): message for message in kept[TRUE_POSE]}
    objects = read_true_objects(path)
    truths = {message.header.stamp.to_nsec(): message for message in kept[TRUE_ECHOES]}
    moments = {}
    for scan in (message for topic in SCANS for message in kept[topic]):
        stamp = scan.header.stamp.to_nsec()
        if stamp in poses and stamp in objects and stamp in truths:
            scanner = mount_of(path, mounts, scan.header.frame_id)
            echoes = _echoes(path, scan, truths[stamp], scanner, poses[stamp].twist.twist)
            base = planar(poses[stamp].pose.pose)
            moments[stamp] = Moment(
                echoes, _bodies(objects[stamp], base), _poles(objects[stamp], base)
            )
    return moments


def _echoes(path, scan, truth, scanner, twist):
    """twist: the vehicle's, for transforming the beams of a scan with a duration to its stamp."""
    if len(truth.surfaces) != len(scan.ranges):
        raise InputError(
            f"{path}: {TRUE_ECHOES} at {scan.header.stamp.to_sec():.6f} s has "
            f"{len(truth.surfaces)} beams, the scan {len(scan.ranges)}, expected as many"
        )
    ranges = np.array([_nearest(beam) for beam in scan.ranges])
    bearings = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    ends = np.column_stack([ranges * np.cos(bearings), ranges * np.sin(bearings), 0.0 * bearings])
    found = np.flatnonzero(np.isfinite(ranges))
    points = [
        transforms.compose(
            transforms.arc(twist.linear.x, twist.angular.z, beam * scan.time_increment),
            np.append(transforms.apply(scanner, ends[beam])[:2], 0.0),
        )[:2]
        for beam in found
    ]
    surfaces = np.frombuffer(truth.surfaces, dtype=np.uint8)[found]
    return Echoes(np.array(points).reshape(-1, 2), surfaces)


def _nearest(beam):
    """Returns the range of the nearest echo, of a LaserScan's beam (a number) or a LaserEcho."""
    if isinstance(beam, float):
        return beam
    return min(beam.echoes, default=math.inf)


def _bodies(objects, base):
    sizes = np.array([(item.size.x, item.size.y) for item in objects]).reshape(-1, 2)
    heights = np.array([item.size.z for item in objects])
    return Bodies(_seen_from(base, objects), sizes, heights)


def _poles(objects, base):
    seen = [item for item in objects if item.label == POLE and STEREO in item.visible_to]
    return _seen_from(base, seen)[:, :2]


def _seen_from(base, objects):
    """Returns the poses (n x 3) of objects in base_link; base: its pose in the map."""
    poses = np.array([planar(item.pose) for item in objects]).reshape(-1, 3)
    return transforms.relative(base, poses)
