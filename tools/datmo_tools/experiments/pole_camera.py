# SPDX-License-Identifier: BSD-3-Clause
"""Measures the benefit of a pole's camera for tracking a pedestrian behind a parked van."""

import tempfile
from pathlib import Path
from typing import NamedTuple

import numpy as np

from datmo_tools import command_line, transforms
from datmo_tools.errors import InputError
from datmo_tools.evaluate.pair_choice import nearest_pairs
from datmo_tools.experiments import pole_camera_bag, simulated_run
from datmo_tools.experiments.pole_camera_bag import PEDESTRIAN
from datmo_tools.pose_path import planar, read_messages
from datmo_tools.programs import StepFailed, call
from datmo_tools.text_table import aligned, rounded

DESCRIPTION = """\
Drives a scene with each seed, adds a satellite receiver and a pole camera's tracks to the bag, and
runs the stack with the scanner alone and with the camera's tracks. Prints when the pedestrian was
first tracked, the NEES of the camera's tracks in the map (position, 2 degrees of freedom), and how
many lists had a track farther than 2 m from all true objects."""

FORMAT = 1  # of the JSON file
SCANNER_ALONE = "track_fusion: {sources: {stereo: {use: false}}}\n"
GATE = 2.0  # m, from a track to the pedestrian
TRACKS, FOREIGN, POSE = "/tracks", "/tracks/v2x", "/pose"


class Outcome(NamedTuple):
    """The result of one drive, s since its start; None: not tracked."""

    alone: float
    with_camera: float
    nees: list  # of each of the camera's tracks in the map
    false_alone: int  # lists with a track that is not near any true object
    false_with_camera: int


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run("pole_camera", lambda: _experiment(values), "report")


def _experiment(values):
    simulated_run.check_programs(values.programs)
    outcomes = [_outcome(values, seed) for seed in range(1, values.seeds + 1)]
    rows = [("seed", "alone (s)", "with camera (s)", "earlier (s)", "NEES", "false lists alone", "with camera")]
    for seed, one in enumerate(outcomes, 1):
        rows.append((str(seed), rounded(one.alone, 2), rounded(one.with_camera, 2),
                     rounded(_earlier(one), 2), rounded(_mean(one.nees), 2),
                     str(one.false_alone), str(one.false_with_camera)))  # fmt: skip
    gains = [_earlier(one) for one in outcomes if _earlier(one) is not None]
    nees = [value for one in outcomes for value in one.nees]
    print(aligned(rows))
    print(f"earlier: median {rounded(_median(gains), 2)} s, least {rounded(min(gains, default=None), 2)} s"
          f" in {len(gains)} of {len(outcomes)} drives; NEES {rounded(_mean(nees), 2)}"
          f" of {len(nees)} tracks, expected 2")  # fmt: skip
    command_line.write_json(values.json, {"format": FORMAT, "drives": [one._asdict() for one in outcomes]})


def _outcome(values, seed):
    """Returns the Outcome of the drive with a seed. Raises InputError."""
    try:
        return _drive(values, seed)
    except StepFailed as error:
        raise InputError(f"seed {seed}: {error}") from error


def _drive(values, seed):
    drive = simulated_run.SimulatedDrive(values.scene, (f"seed={seed}",))
    with tempfile.TemporaryDirectory(prefix="pole_camera_") as name:
        folder = Path(name)
        simulated_run.record(drive, values.programs, folder / "drive.bag")
        truth = pole_camera_bag.write(folder / "drive.bag", folder / "seen.bag", seed, values)
        (folder / "scanner_alone.yaml").write_text(SCANNER_ALONE)
        common = (folder / "seen.bag", "--config", values.config, "--quiet")
        call(values.programs / "run_bag", common[0], folder / "alone.bag", *common[1:])
        call(values.programs / "run_bag", common[0], folder / "with.bag", *common[1:], "--track-fusion",
             "--v2x", "--preset", folder / "scanner_alone.yaml")  # fmt: skip
        return Outcome(
            _first_track(folder / "alone.bag", truth), _first_track(folder / "with.bag", truth),
            _nees(folder / "with.bag", truth), _false_lists(folder / "alone.bag", truth),
            _false_lists(folder / "with.bag", truth),
        )  # fmt: skip


class MapOfRun:
    """Returns true positions in a run's (drifting) map, by the vehicle's true and estimated
    pose."""

    def __init__(self, bag, truth):
        self.truth = truth
        self.poses = {message.header.stamp.to_nsec(): planar(message.pose.pose)
                      for message, _ in read_messages(bag, POSE)}  # fmt: skip
        if not self.poses:
            raise InputError(f"{bag.name}: no pose on {POSE}, expected one or more")
        self.stamps = np.array(sorted(self.poses))

    def position_of(self, item, stamp):
        """Returns the position (m) of an item at a stamp (ns)."""
        near = int(self.stamps[np.argmin(np.abs(self.stamps - stamp))])
        true = min(self.truth.poses, key=lambda pose: abs(pose[0] - near))
        seen = transforms.points_seen_from((*true[1], true[2]), item.at(stamp))
        return transforms.points_in_parent(self.poses[near], seen)


def _first_track(bag, truth):
    """Returns the time (s) of the first list with a track near the walking pedestrian."""
    own = MapOfRun(bag, truth)
    for message, _ in read_messages(bag, TRACKS):
        stamp = message.header.stamp.to_nsec()
        walker = truth.nearest(stamp, PEDESTRIAN)
        if walker is not None and walker.moving and any(
            _distance(track, own.position_of(walker, stamp)) < GATE for track in message.tracks
        ):
            return (stamp - truth.start) * 1e-9
    return None


def _nees(bag, truth):
    """Returns the NEES of each foreign track that is matched to an object; no gate, so that a
    large error counts."""
    own, lists = MapOfRun(bag, truth), []
    for message, _ in read_messages(bag, FOREIGN):
        stamp = message.header.stamp.to_nsec()
        positions = [own.position_of(item, stamp) for item in truth.moving(stamp)]
        errors = [[position - _position(track) for position in positions] for track in message.tracks]
        lists.append((message.tracks, np.reshape(errors, (len(message.tracks), len(positions), 2))))
    chosen = nearest_pairs([np.linalg.norm(errors, axis=2) for _, errors in lists])
    return [_squared_mahalanobis(errors[i, j], tracks[i])
            for (tracks, errors), pairs in zip(lists, chosen) for i, j in pairs]  # fmt: skip


def _squared_mahalanobis(error, track):
    covariance = np.reshape(track.covariance, (6, 6))[:2, :2]
    return float(error @ np.linalg.solve(covariance, error))


def _false_lists(bag, truth):
    count = 0
    own = MapOfRun(bag, truth)
    for message, _ in read_messages(bag, TRACKS):
        stamp = message.header.stamp.to_nsec()
        count += any(
            all(_distance(track, own.position_of(item, stamp)) > GATE for item in truth.all(stamp))
            for track in message.tracks)
    return count


def _position(track):
    return np.array([track.pose.position.x, track.pose.position.y])


def _distance(track, position):
    return float(np.linalg.norm(_position(track) - position))


def _earlier(outcome):
    if outcome.alone is None or outcome.with_camera is None:
        return None
    return outcome.alone - outcome.with_camera


def _mean(values):
    return float(np.mean(values)) if values else None


def _median(values):
    return float(np.median(values)) if values else None


def _parser():
    parser = command_line.new_parser("pole_camera", DESCRIPTION)
    add = parser.add_argument
    add("scene", type=Path, metavar="SCENE.yaml", help="hidden_pedestrian.yaml")
    add("--config", required=True, type=Path, metavar="CONFIG.yaml", help="the sensor set")
    add("--programs", required=True, type=Path, metavar="DIR",
        help="folder of simulate, run_bag and score_run")  # fmt: skip
    add("--seeds", type=command_line.count, default=10, metavar="N",
        help="seeds from 1 (default %(default)s)")  # fmt: skip
    command_line.add_number(parser, "--gnss-sigma", 0.5, "M", "of the receiver's positions, m")
    command_line.add_number(parser, "--camera-sigma", 0.2, "M", "of the camera's detections, m")
    command_line.add_number(parser, "--clock-offset", 0.02, "S", "of the camera's clock, s")
    command_line.add_json(parser)
    return parser
