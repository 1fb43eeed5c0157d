# SPDX-License-Identifier: BSD-3-Clause
"""Step maps: maps of the scanner alone, of low-level and of map-level fusion, and the changes since
a map was made."""

from functools import partial

import yaml

from datmo_tools.evaluate.maps import share
from datmo_tools.evaluate.thesis_tables import PUBLISHED
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.fusion_drives import ODOMETRY_ERRORS
from datmo_tools.figures.recordings import DRIVE_0005
from datmo_tools.figures.step import Job
from datmo_tools.spread import spread_of
from datmo_tools.whole_files import write_whole
from datmo_tools.yaml_files import load_yaml

STEREO = "stereo/enabled=true"
# m, bands in which cells are compared with the Velodyne.
OCCUPIED_BAND, FREE_BAND = (0.0, 15.0), (0.0, 20.0)
CHANGED_SET = 1  # the data set in which parked vehicles are gone
PARKED = {"car", "van"}
EVERY = 5  # one parked vehicle in so many is gone
CHANGES, DRIVE_KITTI = "changes", "drive 0005"

# Level -> its options of run_bag, and the topic of its maps.
LEVELS = {
    "scanner alone": ((), "/map"),
    "low level": (("--low-level-fusion",), "/map"),
    "map level": (("--map-fusion",), "/map/fused"),
}
# Name of a figure -> its counts in the score of evaluate maps.
SHARES = {
    "occupied_right": ("occupied_right", "occupied"),
    "free_right": ("free_right", "free"),
    "things_found": ("things_found", "things"),
    "poles_found": ("poles_found", "poles"),
}


def jobs(bench):
    """Returns a job for each data set and seed, one for the labeled drive, and one for changes."""
    simulated = [Job(f"{number}_{seed}", partial(_simulated, bench, number, seed))
                 for number in range(len(PUBLISHED), 0, -1) for seed in bench.seeds]  # fmt: skip
    labeled = [Job("drive_0005", partial(_labeled, bench))] if (bench.data / DRIVE_0005).is_dir() else []
    return [*labeled, Job(CHANGES, partial(_changes, bench)), *simulated]


def figures(results):
    """Returns for each simulated drive the spread over the seeds, and the other jobs' figures."""
    by_name = {}
    for name, found in results:
        by_name.setdefault(name, []).append(found)
    single = {name: by_name.pop(name)[0] for name in (CHANGES, DRIVE_KITTI) if name in by_name}
    return {"sets": {name: spread_of(found) for name, found in sorted(by_name.items())}, **single}


def _simulated(bench, number, seed, folder):
    drive = folder / "drive.bag"
    _record(bench, bench.scene(f"data_set_{number}"), seed, drive)
    return str(number), {level: _shares(bench, folder, drive, *LEVELS[level]) for level in LEVELS}


def _record(bench, scene, seed, drive):
    simulated_run.record(
        simulated_run.SimulatedDrive(scene, (f"seed={seed}", STEREO)), bench.programs, drive)  # fmt: skip


def _run(bench, drive, computed, config, words):
    bench.call("run_bag", drive, computed, "--config", bench.config(config), "--quiet", *words)


def _shares(bench, folder, drive, words, topic):
    computed = folder / "result.bag"
    _run(bench, drive, computed, "demonstrator", ("--with-truth", *words))
    scored = bench.evaluated(folder, "maps", computed, drive, "--topic", topic)
    return {
        **{name: share(scored, *counts) for name, counts in SHARES.items()},
        **({"conflicts": scored["conflicts"]} if scored["conflicts"] is not None else {}),
    }


def _labeled(bench, folder):
    """The same against the Velodyne, with points from images."""
    drive, computed = folder / "drive.bag", folder / "result.bag"
    bench.call("kitti_to_bag", bench.data / DRIVE_0005, drive, "--points", "--images",
               *ODOMETRY_ERRORS)  # fmt: skip
    found = {}
    for level, (words, topic) in LEVELS.items():
        _run(bench, drive, computed, "kitti", words)
        occupied, free = (
            _band(bench.evaluated(folder, name, computed, drive, "--topic", topic), band)
            for name, band in (("stereo_grids", OCCUPIED_BAND), ("free_cells", FREE_BAND)))  # fmt: skip
        found[level] = {"occupied_right": occupied["precision"], "things_found": occupied["recall"],
                        "free_right": free["precision"]}  # fmt: skip
    return DRIVE_KITTI, found


def _band(scored, limits):
    return next(band for band in scored["bands"] if (band["from"], band["to"]) == limits)


def _changes(bench, folder):
    """A map of one drive, then a drive without some parked vehicles, and one with all of them."""
    scene = bench.scene(f"data_set_{CHANGED_SET}")
    before, saved = folder / "before.bag", folder / "before.map"
    first, second = bench.seeds[0], bench.seeds[0] + 1
    _record(bench, scene, first, before)
    _run(bench, before, folder / "map.bag", "demonstrator", ("--until", "grid_slam", "--save-map", saved))
    write_whole(folder, {"gone.yaml": yaml.safe_dump(without_parked(load_yaml(scene)))})
    found = {}
    for name, changed in (("gone", folder / "gone.yaml"), ("unchanged", scene)):
        drive, computed = folder / "drive.bag", folder / "result.bag"
        _record(bench, changed, second, drive)
        _run(bench, drive, computed, "demonstrator",
             ("--map-fusion", "--with-truth", "--map", saved, "--start", 0, 0, 0))  # fmt: skip
        scored = bench.evaluated(folder, "changes", computed, drive, before)
        found[name] = {kind: scored[kind] for kind in ("vanished", "new")}
    return CHANGES, found


def without_parked(scene):
    """Returns a scene (dict, as in its yaml file) without every EVERY-th parked car or van."""
    parked = [(row, place) for row in scene["rows"] if PARKED & set(row["kinds"])
              for place in range(int((row["to"] - row["from"]) / row["spacing"]) + 1)
              if place not in row.get("leave_out", [])]  # fmt: skip
    gone = parked[EVERY - 1 :: EVERY]
    rows = [{**row, "leave_out": [*row.get("leave_out", []),
                                  *(place for other, place in gone if other is row)]}
            for row in scene["rows"]]  # fmt: skip
    return {**scene, "rows": rows}
