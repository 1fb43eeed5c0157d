# SPDX-License-Identifier: BSD-3-Clause
"""Steps that measure robustness, the operating curve and speed."""

from functools import partial

from datmo_tools import programs
from datmo_tools.evaluate.thesis_tables import PUBLISHED
from datmo_tools.experiments import simulated_run, speed_report
from datmo_tools.experiments.data_sets import SCORE_OPTIONS
from datmo_tools.experiments.fusion_drives import ODOMETRY_ERRORS
from datmo_tools.figures.network import network_of
from datmo_tools.figures.recordings import DRIVE_0005
from datmo_tools.figures.step import Job, read_json

SCENES = ("straight_road", "guard_rails")
ROBUSTNESS_SEEDS = 5

# Only the benchmarks of stages.
HOT_PATHS = (
    "slamStep", "gridUpdate", "detection", "trackerStep", "immPredictAndUpdate", "rankedAssignments",
    "roadBorderScan", "cloudToScan", "stereoGrid", "stereoObjects", "stereoStages", "objectFusion",
    "trackFusion", "fusion", "assessRisks",
)  # fmt: skip

LIVE = ("scans", "unanswered", "latency_ms", "cpu_share", "memory_peak_mib", "memory_growth_mib")


def robustness_jobs(bench):
    """Returns a job for each scene, whose runs are compared with those without vehicles."""
    return [Job(scene, partial(_robustness, bench, scene)) for scene in SCENES]


def _robustness(bench, scene, folder):
    report = folder / "robustness.json"
    bench.experiment("robustness", bench.scene(scene), "--config", bench.config("half_circle"),
                     "--programs", bench.programs, "--seeds", ROBUSTNESS_SEEDS, "--jobs", 1,
                     "--out", report)  # fmt: skip
    keys = ("movers", "runs", "failed", "worst_jump_m", "relative")
    return scene, [{key: row[key] for key in keys} for row in read_json(report)["summary"]]


def operating_curve_jobs(bench):
    """Measures the operating curve of all data sets combined, with road borders."""
    return [Job("data_sets", partial(_operating_curve, bench))]


def _operating_curve(bench, folder):
    drives = [folder / f"data_set_{number}.bag" for number in range(1, len(PUBLISHED) + 1)]
    for drive in drives:
        scene = simulated_run.SimulatedDrive(bench.scene(drive.stem))
        simulated_run.record(scene, bench.programs, drive)
    options = programs.settings(SCORE_OPTIONS)
    curve = bench.evaluated(folder, "operating_curve", *drives, "--config",
                            bench.config("demonstrator"), "--road-border", *options)  # fmt: skip
    keys = ("probability", "missed_share", "false_tracks_per_minute")
    return {
        "shipped": curve["shipped"],
        "points": [{key: point[key] for key in keys} for point in curve["points"]],
    }


def speed_jobs(bench):
    """Measures hot paths and the live chain, one after the other."""
    return [Job("benchmark", partial(_speed, bench))]


def _images(bench, folder):
    """Returns the words for speed_benchmark with a drive with images and a network; none without them."""
    network = network_of(bench, "speed")
    drive = bench.data / DRIVE_0005
    if network is None or not drive.exists():
        return ()
    recorded = folder / "images.bag"
    bench.call("kitti_to_bag", drive, recorded, "--images", *ODOMETRY_ERRORS)
    return "--images", recorded, network


def _speed(bench, folder):
    report = folder / "speed.json"
    bench.call("speed_benchmark", "--source", bench.source, "--build", bench.build, "--out", report,
               *_images(bench, folder))  # fmt: skip
    measured = read_json(report)
    return {
        "cpu_us": {name: run["cpu_us"] for name, run in measured["micro"].items()
                   if name.split("/")[0] in HOT_PATHS},
        "percentiles_us": {name: {key: run[f"{key}_us"] for key in ("median", "percentile_99")}
                           for name, run in measured["micro"].items() if "percentile_99_us" in run},
        "limits": {name: dict(zip(("cpu_us", "limit_us", "ratio"), values))
                   for name, values in speed_report.ratios(measured).items()},
        "live": {
            name: {key: run[key] for key in LIVE}
            for name, run in measured["live"].items()
        },
    }  # fmt: skip
