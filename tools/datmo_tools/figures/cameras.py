# SPDX-License-Identifier: BSD-3-Clause
"""Steps with a stereo camera: the levels of fusion, single objects, fused tracks, grids."""

import math
from functools import partial

from datmo_tools.evaluate.thesis_tables import PUBLISHED
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.data_sets import STEREO_OPTIONS
from datmo_tools.experiments.fusion_comparison import MOTA_COUNTS
from datmo_tools.experiments.fusion_drives import ODOMETRY_ERRORS
from datmo_tools.experiments.fusion_table import IN_VIEW
from datmo_tools.figures.recordings import DRIVE_0005
from datmo_tools.figures.step import Job, read_json
from datmo_tools.spread import pooled_counts, spread_of
from datmo_tools.yaml_files import load_yaml

KITTI = "drive 0005"
CAMERA_DRIVES = ("3", KITTI)  # whose single objects are scored: it takes a minute per drive
# Labels cover only the camera's view.
LABELED_VIEW = ("--visible-to", "none", "--half-angle", "0.7")
FAR = ("--range", "500")

CAMERA = "/objects/stereo"  # topic of its single objects
CLASSES = ("vehicle", "cyclist", "pedestrian")
GRID_ROWS = ("paint_gone", "bodies_lost", "poles_in_lidar", "poles_in_fused")


def fusion_jobs(bench):
    """Returns a job for each drive and seed, at all levels."""
    drives = [(str(number), ("--sets", number, "--seeds", seed), f"data_set_{number}_{seed}")
              for number in range(len(PUBLISHED), 0, -1) for seed in bench.seeds]  # fmt: skip
    if (bench.data / DRIVE_0005).is_dir():
        drives.insert(0, (KITTI, ("--sets",), DRIVE_0005.rpartition("/")[2]))
    return [Job(drive, partial(_fusion, bench, name, words, drive)) for name, words, drive in drives]


def fusion_figures(results):
    """Returns for each drive, and for all simulated ones of a seed combined, the spread over the
    seeds; single objects of the camera and fused tracks are of one seed."""
    by_drive, by_seed = {}, {}
    for result in results:
        by_drive.setdefault(result["drive"], []).append(result)
        if result["drive"] != KITTI:
            by_seed.setdefault(result["run"].rpartition("_")[2], []).append(result["levels"])
    return {
        "drives": {
            name: {"levels": spread_of([one["levels"] for one in runs]),
                   **{key: runs[0][key] for key in ("camera", "tracks")}}
            for name, runs in sorted(by_drive.items())
        },
        "all": spread_of([_together(drives) for drives in by_seed.values()]),
    }  # fmt: skip


def _together(drives):
    """Combines figures by level of several drives (dictionaries by level) as if they were one."""
    counts = ("moving_objects", "missed_objects", "tracks", "false_tracks", *MOTA_COUNTS)
    return {level: pooled_counts([drive[level] for drive in drives], counts)
            for level in drives[0]}  # fmt: skip


def _fusion(bench, name, words, drive, folder):
    kitti = bench.data / DRIVE_0005 if name == KITTI else folder / "none"
    bench.experiment(
        "compare_fusion", "--scenes", bench.scene("any").parent, "--programs", bench.programs,
        "--config", bench.config("demonstrator"), "--kitti-config", bench.config("kitti"),
        "--kitti", kitti, "--jobs", 1, "--out", folder, *words)  # fmt: skip
    runs = read_json(folder / "comparison.json")["runs"]
    view = LABELED_VIEW if name == KITTI else ()
    tracks = bench.evaluated(folder, "track_fusion", folder / drive / "track" / "result.bag",
                             *view, *(FAR if view else ()))  # fmt: skip
    return {
        "drive": name,
        "run": drive,
        "levels": {run["level"]: _level_figures(run["figures"]) for run in runs},
        "camera": _camera(bench, folder, drive, view) if name in CAMERA_DRIVES else None,
        "tracks": _track_figures(tracks),
    }


def _camera(bench, folder, drive, view):
    run = folder / drive / "object" / "result.bag"
    scored = bench.evaluated(folder, "objects", run, "--moving-only", "--topic", CAMERA, *view)
    return _object_figures(scored["topics"][CAMERA])


def _level_figures(run):
    # Without the processing time, which depends on what runs in parallel.
    return {key: value for key, value in run.items() if key not in ("objects", "time_per_scan_ms")}


def _object_figures(scored):
    bands = [*(f"{near:g} to {far:g} m" for near, far in scored["bands_m"]), "all"]
    return {
        "recall": {name: dict(zip(bands, scored["recall"][name]["share"])) for name in CLASSES},
        "class_right": {name: scored["class_right"][name]["share"] for name in CLASSES},
        "along_m": {band: [item["along_mean_m"], item["along_sd_m"]]
                    for band, item in zip(bands, scored["errors"])},
    }  # fmt: skip


def _track_figures(scored):
    followed, false = scored["objects"]["followed_by_all"], scored["false"]
    return {
        "tracks": scored["tracks"],
        "passed": {key: scored["passed"][key] for key in ("tracks", "judged", "true_movers")},
        "followed": {key: followed[key] for key in ("objects", "in_time")},
        "false_in_view": {name: false[name]["in_view"] for name in ("lidar", "fused")},
    }


def grid_jobs(bench):
    """Returns a job for each simulated drive with low-level fusion."""
    return [Job(str(number), partial(_grids, bench, number))
            for number in range(len(PUBLISHED), 0, -1)]  # fmt: skip


def _grids(bench, number, folder):
    recorded, computed = folder / "drive.bag", folder / "result.bag"
    drive = simulated_run.SimulatedDrive(bench.scene(f"data_set_{number}"), STEREO_OPTIONS)
    simulated_run.record(drive, bench.programs, recorded)
    bench.call("run_bag", recorded, computed, "--config", bench.config("demonstrator"),
               "--with-truth", "--quiet", "--low-level-fusion", "--write-grids")  # fmt: skip
    scored = bench.evaluated(folder, "grids", computed, recorded)
    column = scored["columns"].index(IN_VIEW)
    return str(number), {row: {key: scored[row][key][column] for key in ("percent", "of")}
                         for row in GRID_ROWS}  # fmt: skip


def stereo_grid_jobs(bench):
    """Measures stereo grids on the labeled drive's image pairs."""
    return [Job("drive_0005", partial(_stereo_grids, bench))]


def _stereo_grids(bench, folder):
    recorded, computed, config = folder / "drive.bag", folder / "result.bag", bench.config("kitti")
    bench.call("kitti_to_bag", bench.data / DRIVE_0005, recorded, "--points", "--images",
               *ODOMETRY_ERRORS)  # fmt: skip
    bench.call("run_bag", recorded, computed, "--config", config, "--quiet", "--low-level-fusion",
               "--write-grids")  # fmt: skip
    settings = load_yaml(config)
    first_column = settings["stereo_image_proc"]["disparity_range"]
    views = {"in_view": 0.0, "matched": first_column}
    scores = {name: bench.evaluated(folder, "stereo_grids", computed, recorded,
                                    "--first-column", column)
              for name, column in views.items()}  # fmt: skip
    return {
        _band(band): {"precision": band["precision"], "recall": band["recall"],
                      "recall_in_view": seen["recall"]}
        for band, seen in zip(scores["matched"]["bands"], scores["in_view"]["bands"])
        if math.isfinite(band["to"])
    }  # fmt: skip


def _band(band):
    return f"{band['from']:g} to {band['to']:g} m"
