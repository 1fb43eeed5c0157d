# SPDX-License-Identifier: BSD-3-Clause
"""evaluate track_fusion."""

from pathlib import Path
from typing import NamedTuple

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate.arguments import add_region, add_truth, region_of
from datmo_tools.evaluate.confirmed_objects import score_confirmed
from datmo_tools.evaluate.false_tracks import reduction, score_false
from datmo_tools.evaluate.passed_tracks import score_passed
from datmo_tools.evaluate.track_frames import Scene
from datmo_tools.evaluate.track_ghosts import score_ghosts
from datmo_tools.evaluate.track_lists import TRACKS, read_track_lists
from datmo_tools.evaluate.track_table import sections
from datmo_tools.evaluate.truth import ANY, NONE, Region

DESCRIPTION = """\
Scores the fusion of tracks (thesis 3.4) in a result of run_bag --track-fusion: /tracks, the fused
ones, against /tracks/lidar and /tracks/stereo, from which they are made, and the true objects.

  table 3.3    ids of both sensors' tracks, and of the fused tracks that passed the test of both:
               that had a track of each at some time
  true         a fused track that passed follows one true object, which moves at some time, in most
               of the frames in which both sensors have it, it is published as moving and lies in
               the region; second reading: a road user, moving or not (a parked car that is taken as
               moving is false in the first); pairs: both its tracks follow the same road user
  passing      of the true moving objects that have a track of both sensors at the same time, how
               many pass, and within how much of this time; the same of those that are visible to
               both sensors
  false        tracks within the camera's view (sector and range, as published with /tracks/stereo)
               that match no true object in most of their frames, as score_run counts them: of each
               list; visible: nothing that the camera saw occludes them
  ghosts       fused tracks on an object that has another one; objects that change their track

False, late and missed tracks are listed with stamp and position. KITTI's labels cover only the
camera's view, and do not tell which sensor sees what: --visible-to none --range 500 --half-angle
0.7."""

# By source, the name of its sensor in the truth.
SENSORS = {"lidar": "scanner", "stereo": "stereo"}
CAMERA = "stereo"  # the source whose views are used

RANGE = 50.0  # m, as score_run's region/range
GATE = 2.0  # m, as score_run's matching/gate
SOON = 0.5  # s


class Limits(NamedTuple):
    """Options of the score."""

    region: Region = Region(RANGE)
    visible_to: str = ANY  # sensor that must see an object for it to have to be found
    gate: float = GATE  # m, from a track to the box of its object
    soon: float = SOON  # s, within which an object that both follow has to pass


def score(run, drive=None, limits=Limits()):
    """Returns the score of the tracks in the bag `run` (Path) as a dictionary that JSON can hold.

    drive: bag with the truth (Path), by default `run`. Raises InputError, also if nothing can be
    scored.
    """
    topics = {"fused": TRACKS, **{source: f"{TRACKS}/{source}" for source in SENSORS}}
    lists = read_track_lists(run, topics.values())
    lists = {name: lists[topic] for name, topic in topics.items()}
    scene = Scene(run, drive or run, limits.region, limits.visible_to, limits.gate)
    frames = {name: scene.frames(topics[name], items) for name, items in lists.items()}
    if not frames["fused"]:
        raise InputError(f"{run}: no list of tracks has a stamp near one of truth and pose")
    fused, members = frames["fused"], {source: frames[source] for source in SENSORS}
    false = score_false(frames, lists[CAMERA], limits.gate)
    return {
        "run": str(run), "drive": str(drive or run),
        "range_m": limits.region.range, "half_angle_rad": limits.region.half_angle,
        "visible_to": limits.visible_to, "gate_m": limits.gate,
        "frames": len(fused), "without_truth": len(lists["fused"]) - len(fused),
        "tracks": {name: _ids(items) for name, items in lists.items()},
        "passed": score_passed(fused, members, limits.gate),
        "objects": score_confirmed(fused, members, limits.gate, limits.soon, SENSORS.values()),
        "false": {
            "views": any(item.views for item in lists[CAMERA]), **false,
            "reduction": reduction(false["lidar"]["in_view"], false["fused"]["in_view"]),
            "frames_reduction": reduction(_per_frame(false["lidar"]), _per_frame(false["fused"])),
        },
        "ghosts": {name: score_ghosts(items, limits.gate) for name, items in frames.items()},
    }  # fmt: skip


def _ids(lists):
    return len({track.id for item in lists for track in item.tracks})


def _per_frame(item):
    return item["in_view_frames"] / item["frames"] if item["frames"] else 0.0


def evaluate(values):
    """Returns the score and its sections. Raises InputError."""
    command_line.check_positive(values, "gate", "soon")
    limits = Limits(region_of(values), values.visible_to, values.gate, values.soon)
    result = score(values.run, values.truth, limits)
    return result, sections(result)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("run", type=Path, metavar="RUN.bag", help="bag of run_bag --track-fusion")
    add_truth(parser)
    add("--visible-to", default=ANY, metavar="SENSOR",
        help="sensor that must see a true object for it to have to be found, "
        f"{ANY}, or {NONE}: not required (default %(default)s)")  # fmt: skip
    add_region(parser, RANGE)
    command_line.add_number(parser, "--gate", GATE, "M",
                            "from a track to the box of its true object, m")  # fmt: skip
    command_line.add_number(parser, "--soon", SOON, "S",
                            "time within which objects that both sensors track must pass, s")  # fmt: skip
