# SPDX-License-Identifier: BSD-3-Clause
"""Measures what gaps of scans and odometry, and being carried elsewhere, do to the pose: the
command line and the runs."""

import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import rospy
from tqdm import tqdm

from datmo_tools import command_line, programs
from datmo_tools.bag_file import whole_bag
from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.carried_drive import CarriedDrive
from datmo_tools.experiments.gap_score import CARRIED, Gap, passed, score, table
from datmo_tools.pose_path import read_path
from datmo_tools.stamps import NANOSECONDS

DESCRIPTION = """\
Removes parts of scans, of odometry or of both from drives, at regular times, and prints the
error of the final pose, and whether it was ever overconfident. 'carried' removes a part of all
sensors and joins the rest: the vehicle was carried elsewhere, and its odometry does not know. A
drive is a scene for the simulator, or a bag with /ground_truth/pose. The exit code is 1 if a run
ended with an error of more than 0.5 m + 1 % of the distance or 2 degrees (after 'carried' this is
allowed if the covariance admits it), had a pose with this error and less than a third of it as
standard deviation, or failed."""

FORMAT = 1  # of the JSON file
PROGRAMS = ("simulate", "run_bag")
KINDS = ("scan", "odometry", "both", CARRIED)
TRUTH = "/ground_truth/pose"
ODOMETRY = ("/odometry", "/tf")
SCANS = ("/echoes", "/scan")
ALWAYS = ("/tf_static", TRUTH)
# Enough of a drive before the gap to fill the map, and enough after it to find the pose again.
LEAD = 12.0  # s
TAIL = 6.0  # s


class Case(NamedTuple):
    """One run."""

    recorded: Path
    gap: Gap


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    complete = []
    code = command_line.run("gaps", lambda: complete.append(_sweep(values)), "report")
    return code or int(not complete[0])


def cut(recorded, gap, written):
    """Writes the drive (Path) around a gap, without what the gap removes, to a bag (Path)."""
    if gap.kind == CARRIED:
        carry(recorded, gap, written)
        return
    first = gap.begin - round(LEAD * NANOSECONDS)
    last = gap.end + round(TAIL * NANOSECONDS)
    gone = {"scan": SCANS, "odometry": ODOMETRY, "both": SCANS + ODOMETRY}[gap.kind]
    with opened(recorded) as bag, whole_bag(written, "gaps") as out:
        for topic, message, stamp in bag.read_messages([*ALWAYS, *SCANS, *ODOMETRY]):
            at = stamp.to_nsec()
            if topic == "/tf_static":
                out.write_latched(topic, at if at >= first else first, message)
            elif first <= at <= last and not (topic in gone and gap.begin < at <= gap.end):
                out.write(topic, at, message)


def carry(recorded, gap, written):
    """Writes the drive (Path) around a gap to a bag (Path), with its two parts joined."""
    duration = gap.end - gap.begin
    drive = CarriedDrive(rospy.Duration(nsecs=duration))
    first = gap.begin - round(LEAD * NANOSECONDS)
    last = gap.end + round(TAIL * NANOSECONDS)
    with opened(recorded) as bag, whole_bag(written, "gaps") as out:
        for topic, message, stamp in bag.read_messages([*ALWAYS, *SCANS, *ODOMETRY]):
            at = stamp.to_nsec()
            if topic == "/tf_static":
                out.write_latched(topic, at if at >= first else first, message)
            elif first <= at <= gap.begin:
                drive.pass_before(topic, message)
                out.write(topic, at, message)
            elif gap.end < at <= last:
                drive.move(topic, message)
                out.write(topic, at - duration, message)


def gaps_of(recorded, values):
    """Returns a list of Gap at regular times of a drive (Path)."""
    stamps = read_path(recorded, TRUTH).stamps
    step = round(values.every * NANOSECONDS)
    first = int(stamps[0]) + round(values.first * NANOSECONDS)
    return [
        Gap(kind, begin, seconds)
        for kind in values.kinds
        for seconds in values.seconds
        for begin in range(first, int(stamps[-1] - (seconds + TAIL) * NANOSECONDS), step)
    ]


def run_case(case, values):
    """Returns the result (dict) of one run; a run that failed has no pose, and its error."""
    begin = case.gap.begin / NANOSECONDS
    result = {"drive": case.recorded.stem, "kind": case.gap.kind, "begin_s": begin,
              "seconds": case.gap.seconds}  # fmt: skip
    try:
        return {**result, "error": None, "score": _scored(case, values)}
    except (programs.StepFailed, InputError) as error:
        return {**result, "error": str(error), "score": {"scans": 0, "without_pose": True}}


def _scored(case, values):
    """Returns the score (dict) of one run. Raises StepFailed, InputError."""
    with tempfile.TemporaryDirectory(prefix="gaps_") as name:
        folder = Path(name)
        drive, computed = folder / "drive.bag", folder / "result.bag"
        cut(case.recorded, case.gap, drive)
        options = [word for preset in values.preset for word in ("--preset", preset)]
        programs.call(values.programs / "run_bag", drive, computed, "--config", values.config,
                      "--until", "grid_slam", "--quiet", *options)  # fmt: skip
        return score(computed, drive, case.gap)


def _sweep(values):
    """Whether all runs passed."""
    for file in [*values.drives, values.config]:
        if not file.is_file():
            raise InputError(f"{file}: no such file, expected a scene, a bag or a yaml file")
    programs.check(values.programs, PROGRAMS)
    with tempfile.TemporaryDirectory(prefix="gaps_") as folder:
        drives = [_recorded(drive, values, Path(folder)) for drive in values.drives]
        cases = [Case(drive, gap) for drive in drives for gap in gaps_of(drive, values)]
        with ThreadPoolExecutor(values.jobs) as pool:
            runs = list(tqdm(pool.map(lambda case: run_case(case, values), cases), "runs",
                             len(cases)))  # fmt: skip
    command_line.write_json(values.out, {"format": FORMAT, "config": str(values.config), "runs": runs})
    print(table(runs))
    for run in runs:
        if not passed(run["score"]):
            print(_line(run))
    return all(passed(run["score"]) for run in runs)


def _line(run):
    """Describes one run that did not pass."""
    where = f"{run['drive']}, {run['kind']} {run['seconds']:g} s from {run['begin_s']:.1f} s"
    scored = run["score"]
    if run["error"] is not None:
        return f"{where}: {run['error']}"
    if scored["without_pose"]:
        return f"{where}: no pose before it, or none after it"
    end = scored["end"]
    motion = ""
    if "speed_mps" in scored:
        motion = f" ({scored['speed_mps']:.1f} m/s, turn {scored['turn_deg']:.0f} deg)"
    return (
        f"{where}{motion}: ends "
        f"{end['position_m']:.2f} m, {end['heading_deg']:.1f} deg off, "
        f"sigma {end['sigma_m']:.2f} m, {end['sigma_deg']:.1f} deg; "
        f"{scored['confident_wrong']} of {scored['scans']} scans "
        "confident and wrong"
    )


def _recorded(drive, values, folder):
    """Returns the bag (Path) of a drive; a scene is simulated into `folder`."""
    if drive.suffix == ".bag":
        return drive
    recorded = folder / f"{drive.stem}.bag"
    options = tuple(values.set)
    try:
        simulated_run.record(simulated_run.SimulatedDrive(drive, options), values.programs, recorded)
    except programs.StepFailed as error:
        raise InputError(f"{drive}: {error}") from error
    return recorded


def _parser():
    parser = command_line.new_parser("gaps", DESCRIPTION)
    add = parser.add_argument
    add("drives", nargs="+", type=Path, metavar="DRIVE", help="SCENE.yaml, or DRIVE.bag with truth")
    add("--config", required=True, type=Path, metavar="CONFIG.yaml", help="the sensor set")
    add("--programs", required=True, type=Path, metavar="DIR", help="of simulate and run_bag")
    add("--preset", action="append", default=[], metavar="FILE.yaml", help="for run_bag, repeatable")
    add("--set", action="append", default=[], metavar="KEY=VALUE", help="for simulate, repeatable")
    add("--kinds", nargs="+", choices=KINDS, default=KINDS, help="what is missing (default all)")
    add("--seconds", nargs="+", type=command_line.number, default=[0.2, 0.5, 1.0, 2.0, 5.0],
        metavar="S", help="lengths of the gaps (default 0.2 0.5 1 2 5)")  # fmt: skip
    add("--jobs", type=command_line.count, default=1, metavar="N",
        help="parallel runs (default 1)")  # fmt: skip
    add("--out", type=command_line.output_file, metavar="FILE.json", help="all runs")
    command_line.add_number(parser, "--first", 8.0, "S", "time of the first gap")
    command_line.add_number(parser, "--every", 5.0, "S", "time from a gap to the next one")
    return parser
