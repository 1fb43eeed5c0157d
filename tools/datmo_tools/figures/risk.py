# SPDX-License-Identifier: BSD-3-Clause
"""Step risk: encounters after public test protocols by all methods, and false warnings in dense traffic
and on KITTI's drive 0005."""

from functools import partial

from datmo_tools.evaluate.risk import score_of
from datmo_tools.evaluate.thesis_tables import PUBLISHED
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.encounters import METHODS, OWN, RESULT, TRUE
from datmo_tools.experiments.fusion_drives import ODOMETRY_ERRORS
from datmo_tools.figures.recordings import DRIVE_0005
from datmo_tools.figures.step import Job, read_json

OURS = METHODS[0]
RELIABILITY = "4"  # s within which contact is said, for the diagram
TRAFFIC = "traffic"  # the simulated data sets, one seed
DRIVE = "drive_0005"  # of KITTI, if its data is there
SCAN_RESOLUTION = 2  # degrees, of its scan
RANDOM = "random"  # encounters drawn at random, the true objects
RANDOM_DRIVES = 2000


def jobs(bench):
    """A job for each kind of encounters, one for each data set, and one for the drive."""
    drives = [Job(f"{TRAFFIC}_{number}", partial(_traffic, bench, number))
              for number in range(len(PUBLISHED), 0, -1)]  # fmt: skip
    random = Job(RANDOM, partial(_encounters, bench, RANDOM, TRUE, ("--random", RANDOM_DRIVES)))
    protocols = [Job(tracks, partial(_encounters, bench, tracks, tracks, ())) for tracks in (OWN, TRUE)]
    if (bench.data / DRIVE_0005).is_dir():
        drives.append(Job(DRIVE, partial(_drive_0005, bench)))
    return [random, *drives, *protocols]


def figures(results):
    """By kind of encounters and method; of the data sets together the warnings and their duration."""
    found = {name: figure for name, figure in results if name != TRAFFIC}
    drives = [figure for name, figure in results if name == TRAFFIC]
    found[TRAFFIC] = {key: sum(drive[key] for drive in drives) for key in ("warnings", "seconds")}
    return found


def _encounters(bench, name, tracks, words, folder):
    bench.experiment("encounters", folder, "--programs", bench.programs, "--tracks", tracks,
                     "--config", bench.config("demonstrator"), *words)  # fmt: skip
    scored = read_json(folder / RESULT)[tracks]
    return name, {method: _of_method(scored[method], method == OURS) for method in METHODS}


def _of_method(scored, with_reliability):
    horizons = scored.pop("horizons")
    kept = {
        "brier": {name: item["brier"] for name, item in horizons.items()},
        "calibration_error": {name: item["calibration_error"] for name, item in horizons.items()},
    }
    if with_reliability:
        kept["reliability"] = horizons[RELIABILITY]["reliability"]
    return {**scored, **kept}


def _traffic(bench, number, folder):
    recorded = folder / "drive.bag"
    simulated_run.record(simulated_run.SimulatedDrive(bench.scene(f"data_set_{number}")),
                         bench.programs, recorded)  # fmt: skip
    return TRAFFIC, _warnings(bench, "demonstrator", recorded)


def _drive_0005(bench, folder):
    recorded = folder / "drive.bag"
    bench.call("kitti_to_bag", bench.data / DRIVE_0005, recorded, "--scan-resolution", SCAN_RESOLUTION,
               *ODOMETRY_ERRORS)  # fmt: skip
    return DRIVE, _warnings(bench, "kitti", recorded)


def _warnings(bench, config, recorded):
    """Returns how many warnings there are on a drive without contact, and its duration."""
    computed = recorded.with_name("result.bag")
    bench.call("run_bag", recorded, computed, "--config", bench.config(config), "--road-border", "--risk",
               "--with-truth", "--quiet")  # fmt: skip
    scored = score_of([computed])
    return {"warnings": scored["false_warnings"], "seconds": 3600.0 * scored["hours"]}
