# SPDX-License-Identifier: BSD-3-Clause
"""The figures of recordings that end-to-end tests bound, like those of simulated scenes. A seed
greater than 1 adds noise, half of the sensor's, to the measurements: how much a figure depends on
chance is measured so."""

import functools
import json
import os
import subprocess

import numpy as np
import rosbag
from datmo_tools.convert.kitti_to_bag import main as kitti_to_bag
from datmo_tools.convert.mocap_to_bag import main as mocap_to_bag
from drive_0005 import DATA, DRIVE
from evaluated_run import evaluated
from scene_runs import ROOT, computed

SCAN = "/scan"

KITTI = ROOT / "config" / "kitti.yaml"
# The odometry is 3 % too long and turns 0.5 deg/s too much; alone it ends off by 8 % of the distance.
ODOMETRY_ERRORS = ("--odometry-scale-error", "0.03", "--odometry-yaw-bias", "0.5")
KITTI_NOISE = 0.01  # m: half of the Velodyne's
# All that moves has to be found, wherever it is labeled: in the cameras' field of view.
KITTI_ASKED = (
    "truth/visible_to=none",
    "truth/min_time_seen=0",
    "region/range=500",
    "region/half_angle=0.7",
)
WHOLE_DRIVE = 0.9  # share of the frames in which an object of the whole drive moves

CARS = DATA / "datmo_bags"
CARS_CONFIG = ROOT / "config" / "model_car.yaml"
CARS_NOISE = 0.0075  # m: half of the scanner's
# A tenth of a real car's.
CARS_ASKED = ("matching/gate=0.4", "matching/distance=to_center")


TRACKING = DATA / "kitti_tracking"
TRACKING_NOISE = 0.05  # m: about half of the detections' in each direction
POSITION_COLUMNS = (10, 12)  # of the detections: x, z
TRACKING_RUN = os.environ.get("KITTI_TRACKING_RUN", "kitti_tracking_run")
TRACKING_SCORE = os.environ.get("KITTI_TRACKING_SCORE", "kitti_tracking_score")


def drive_0005(degrees, folder, seed):
    """KITTI's drive 0005 with beams every `degrees`."""
    recorded = folder / f"drive_0005_{degrees}_{seed}.bag"
    words = [str(DRIVE), str(recorded), "--scan-resolution", str(degrees), *ODOMETRY_ERRORS]
    if kitti_to_bag(words) != 0:
        raise RuntimeError("kitti_to_bag failed")
    recorded = noisy(recorded, seed, KITTI_NOISE)
    score = evaluated(computed(recorded, config=KITTI), recorded, KITTI_ASKED)
    cyclists, vehicles = (whole_drive(score, kind) for kind in ("cyclist", "vehicle"))
    parked = [item for item in score["standing_objects"] if item["class"] == "vehicle"]
    return {
        "pose_error": score["pose"]["end_error_share"],
        "mota": score["clear_mot"]["mota"],
        "cyclist_tracked": min(item["completeness"] for item in cyclists),
        "vehicle_tracked": min(item["completeness"] for item in vehicles),
        "ids": max(len(item["track_ids"]) for item in cyclists + vehicles),
        "parked_moving_share": max(item["tracked_frames"] / item["frames"] for item in parked),
        "false_movers_per_frame": score["false_movers_per_frame"],
    }


def whole_drive(score, kind):
    """Returns the objects of a class that move and are labeled in nearly every frame: the van and
    the cyclist, selected by that, not by their ids."""
    return [item for item in score["objects"]
            if item["class"] == kind and item["required_frames"] >= WHOLE_DRIVE * score["frames"]]  # fmt: skip


def model_car(name, folder, seed):
    """One of the example bags of the package datmo: a 1:10 car, another one, motion capture."""
    recorded = folder / f"{name}_{seed}.bag"
    if mocap_to_bag([str(CARS / f"{name}.bag"), str(recorded)]) != 0:
        raise RuntimeError("mocap_to_bag failed")
    recorded = noisy(recorded, seed, CARS_NOISE)
    score = evaluated(computed(recorded, config=CARS_CONFIG), recorded, CARS_ASKED)
    counts = score["clear_mot"]
    return {
        "pose_rmse_m": score["pose"]["position_rmse_m"],
        **{key: score["errors"][key] for key in ("position_rmse_m", "velocity_rmse_mps", "heading_rmse_rad")},
        "id_switches": counts["id_switches"],
        "false_movers_per_frame": score["false_movers_per_frame"],
        "tracked_share": counts["matches"] / counts["required"],
    }  # fmt: skip


def kitti_tracking(folder, seed):
    """PointRCNN's detections of ten KITTI tracking sequences, at an overlap of 0.25."""
    detections, results = TRACKING / "pointrcnn", folder / f"results_{seed}"
    if seed > 1:
        detections = noisy_detections(detections, folder / f"detections_{seed}", seed)
    run_tracking(results, detections)
    figures = {}
    for kind, score in tracking_scores(results, folder).items():
        figures[f"{kind.lower()}_samota"] = score["samota"]
        figures[f"{kind.lower()}_id_switches"] = score["best"]["id_switches"]
    return figures


def run_tracking(results, detections=TRACKING / "pointrcnn", options=()):
    """Runs kitti_tracking_run on detections, with options; results: folder (Path)."""
    subprocess.run([TRACKING_RUN, str(detections), str(TRACKING / "calib"), str(results),
                    "--config", str(ROOT / "config" / "kitti_tracking"), *options], check=True)  # fmt: skip


def tracking_scores(results, folder, kind="all"):
    """Returns what kitti_tracking_score reports, by class."""
    report = folder / "report.json"
    subprocess.run([TRACKING_SCORE, str(TRACKING / "label_02"), str(results), "--class", kind,
                    "--iou", "0.25", "--out", str(report)], check=True)  # fmt: skip
    return {score["class"]: score for score in json.loads(report.read_text(encoding="utf-8"))}


def noisy_detections(detections, written, seed):
    """Copies detections with normal noise on the positions on the ground; returns the folder."""
    random = np.random.default_rng(seed)
    for file in sorted(detections.glob("*/*.txt")):
        rows = [line.split(",") for line in file.read_text(encoding="ascii").splitlines()]
        for row in rows:
            for column in POSITION_COLUMNS:
                row[column] = f"{float(row[column]) + random.normal(0.0, TRACKING_NOISE):.4f}"
        copy = written / file.relative_to(detections)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text("".join(",".join(row) + "\n" for row in rows), encoding="ascii")
    return written


def noisy(recorded, seed, sigma):
    """Returns a bag (Path) with normal noise on all ranges, of this standard deviation (m); for seed
    1 the recording itself."""
    if seed == 1:
        return recorded
    path, random = recorded.with_suffix(".noisy.bag"), np.random.default_rng(seed)
    with rosbag.Bag(str(recorded)) as source, rosbag.Bag(str(path), "w") as target:
        for topic, message, time in source.read_messages():
            if topic == SCAN:
                message.ranges = np.asarray(message.ranges) + random.normal(0.0, sigma, len(message.ranges))
            target.write(topic, message, time)
    return path


RECORDINGS = {
    "drive_0005_2_degrees": functools.partial(drive_0005, 2),
    "drive_0005_1_degree": functools.partial(drive_0005, 1),
    "overtake_ego": functools.partial(model_car, "overtake_ego"),
    "overtake_red": functools.partial(model_car, "overtake_red"),
    "kitti_tracking": kitti_tracking,
}
