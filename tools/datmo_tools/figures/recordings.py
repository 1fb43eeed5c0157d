# SPDX-License-Identifier: BSD-3-Clause
"""Steps on recordings that are not in the repository, except those with a camera."""

import re
import zipfile
from functools import partial

from datmo_tools.errors import InputError
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.fusion_drives import LABELED, ODOMETRY_ERRORS
from datmo_tools.figures.step import Job, preset, read_json

DRIVE_0005 = "kitti_raw/2011_09_26/2011_09_26_drive_0005_sync"
KITTI_TRACKING = "kitti_tracking"
SLAM_LOGS = "slam2d"
MODEL_CARS = "datmo_bags"
PEOPLE = "people_2d/general_tracking_moving_1.bag.zip"

OVERLAPS = (0.25, 0.5, 0.7)  # IoU, of KITTI tracking
# A tenth of a real car's, between the centers of the bodies.
MODEL_CAR_SCORE = ("matching/gate=0.4", "matching/distance=to_center")
PEOPLE_LABELS = "/ground_truth_people_tracks"

VELODYNE_NOISE = "attainable/range_noise=0.02"  # option of score_run

NO_ODOMETRY = {"motion": {"source": "none"}}

WHOLE_DRIVE = 0.9  # share of the frames: an object in so many is there for the whole drive


def drive_0005_jobs(bench):
    """Returns jobs of the scanner alone: beams every 2 degrees, every degree, no odometry."""
    variants = {
        "2 degrees": (2, (), {}),
        "2 degrees, road borders": (2, ("--road-border",), {}),
        "1 degree": (1, (), {}),
        "2 degrees, no odometry": (2, (), NO_ODOMETRY),
    }
    return [
        Job(name.replace(" ", "_"), partial(_drive_0005, bench, name, *variant))
        for name, variant in variants.items()
    ]


def _drive_0005(bench, name, resolution, words, settings, folder):
    words = (*words, *preset(folder, settings)) if settings else words
    recorded = folder / "drive.bag"
    bench.call("kitti_to_bag", bench.data / DRIVE_0005, recorded,
               "--scan-resolution", resolution, *ODOMETRY_ERRORS)  # fmt: skip
    options = (*LABELED, VELODYNE_NOISE)
    report = simulated_run.run_recorded(
        recorded, bench.programs, bench.config("kitti"), folder, options, words, recorded)  # fmt: skip
    return name, drive_figures(report)


def drive_figures(report):
    """Returns figures of a labeled drive, from score_run's report."""
    whole = [item for item in report["objects"]
             if item["required_frames"] >= WHOLE_DRIVE * report["frames"]]  # fmt: skip
    brief = [item for item in report["objects"] if item not in whole]
    standing = report["standing_objects"]
    return {
        "pose_end_error_m": report["pose"]["end_error_m"],
        "pose_end_error_share": report["pose"]["end_error_share"],
        "mota": report["clear_mot"]["mota"],
        "false_movers_per_frame": report["false_movers_per_frame"],
        "delay_ratio": report["attainable"]["ratio"]["median"],
        "whole_drive": [{"class": item["class"], "tracked": item["completeness"],
                         "ids": len(item["track_ids"])} for item in whole],  # fmt: skip
        "brief": {"objects": len(brief), "found": sum(item["found"] for item in brief)},
        "standing": {"objects": len(standing),
                     "tracked": sum(item["tracked_frames"] > 0 for item in standing)},  # fmt: skip
    }


def kitti_tracking_jobs(bench):
    """Measures all classes and overlaps at once."""
    return [Job("sequences", partial(_kitti_tracking, bench))]


def _kitti_tracking(bench, folder):
    data, results = bench.data / KITTI_TRACKING, folder / "results"
    said = bench.output_of("kitti_tracking_run", data / "pointrcnn", data / "calib", results,
                           "--config", bench.config("kitti_tracking").with_suffix(""))  # fmt: skip
    classes = {}
    for overlap in OVERLAPS:
        report = folder / "report.json"
        bench.call("kitti_tracking_score", data / "label_02", results,
                   "--class", "all", "--iou", overlap, "--out", report)  # fmt: skip
        for score in read_json(report):
            classes.setdefault(score["class"], {})[f"{overlap:g}"] = _tracking_figures(score)
    return {**classes, "frames_per_second": frames_per_second(said)}


def frames_per_second(said):
    """Returns the speed that kitti_tracking_run prints: of the trackers of all classes, and with the
    estimation of the vehicle's motion."""
    rates = re.search(r"(\d+) frames/s by the trackers.*, (\d+) with the vehicle's motion", said)
    if rates is None:
        raise InputError(f"kitti_tracking_run: expected frames/s in its output, found {said!r}")
    return dict(zip(("trackers", "with_ego_motion"), map(int, rates.groups())))


def _tracking_figures(score):
    keys = ("mota", "motp", "id_switches", "fragmentations")
    return {**{key: score[key] for key in ("samota", "amota", "amotp")},
            **{key: score["best"][key] for key in keys}}  # fmt: skip


def slam_jobs(bench):
    """Measures all available logs of the SLAM benchmark."""
    return [Job("logs", partial(_slam, bench))]


def _slam(bench, folder):
    report = folder / "slam.json"
    bench.experiment("slam_benchmark", bench.data / SLAM_LOGS, "--programs", bench.programs,
                     "--config", bench.config("indoor"), "--out", report)  # fmt: skip
    keys = ("translation_m", "rotation_deg")
    return {
        item["log"]: {
            **{name: {key: _mean_and_std(item[name][key]) for key in keys}
               for name in ("odometry", "pose", "loops_closed")},
            "relations": item["pose"]["used"],
            "relations_of_loops": item["loops_closed"]["used"],
            "scans": item["time"]["runs"],
            "median_time_ms": 1e3 * item["time"]["median_s"],
        }
        for item in read_json(report)["results"]
    }  # fmt: skip


def _mean_and_std(figures):
    return {key: figures[key] for key in ("mean", "std")}


def model_car_jobs(bench):
    """Returns a job for each bag."""
    bags = sorted((bench.data / MODEL_CARS).glob("*.bag"))
    return [Job(bag.stem, partial(_model_cars, bench, bag)) for bag in bags]


def _model_cars(bench, bag, folder):
    recorded = folder / "drive.bag"
    bench.call("mocap_to_bag", bag, recorded)
    report = simulated_run.run_recorded(
        recorded, bench.programs, bench.config("model_car"), folder, MODEL_CAR_SCORE)  # fmt: skip
    counts = report["clear_mot"]
    keys = ("position_rmse_m", "velocity_rmse_mps", "heading_rmse_rad")
    return bag.stem, {
        **{key: report["errors"][key] for key in keys},
        "id_switches": counts["id_switches"],
        "false_movers_per_frame": report["false_movers_per_frame"],
        "tracked_share": counts["matches"] / counts["required"],
    }


def people_jobs(bench):
    """Measures the recording with the yaml file that check_bag writes for it."""
    return [Job("recording", partial(_people, bench))]


def _people(bench, folder):
    with zipfile.ZipFile(bench.data / PEOPLE) as archive:
        recorded = folder / archive.extract(next(iter(archive.namelist())), folder)
    config, computed = folder / "people.yaml", folder / "result.bag"
    bench.call("check_bag", recorded, "--out", config)
    bench.call("run_bag", recorded, computed, "--config", config, "--quiet", "odometry:=/odom")
    report = bench.evaluated(folder, "labels", computed, recorded, "--labels", PEOPLE_LABELS)
    keys = ("positions", "found", "found_share", "median_distance_m", "id_switches", "ids")
    return {**{key: report[key] for key in keys}, "never_found": len(report["ids_never_found"])}
