# SPDX-License-Identifier: BSD-3-Clause
"""All steps of scripts/figures, in the order of the file of figures; those that measure time run last."""

from datmo_tools.figures import cameras, data_sets, maps, measurements, mono, recordings, risk, wrong_classes
from datmo_tools.figures.step import Step, by_name, only

STEPS = (
    Step("kitti_tracking", "tracker on KITTI tracking", "kitti_tracking_run, kitti_tracking_score",
         recordings.kitti_tracking_jobs, only, (recordings.KITTI_TRACKING,), timed=True),
    Step("model_cars", "1:10 cars", "mocap_to_bag, run_bag, score_run", recordings.model_car_jobs,
         by_name, (recordings.MODEL_CARS,)),
    Step("people", "people around a robot", "check_bag, run_bag, evaluate labels",
         recordings.people_jobs, only, (recordings.PEOPLE,)),
    Step("slam", "pose indoors", "scripts/slam_benchmark", recordings.slam_jobs, only,
         (recordings.SLAM_LOGS,), timed=True),
    Step("drive_0005", "KITTI's drive 0005, the scanner alone", "kitti_to_bag, run_bag, score_run",
         recordings.drive_0005_jobs, by_name, (recordings.DRIVE_0005,)),
    Step("data_sets", "simulated data sets without and with borders of the road",
         "scripts/data_sets --road-border", data_sets.jobs, data_sets.figures, seeded=True),
    Step("fusion", "levels of fusion, single objects of the camera, fused tracks",
         "scripts/compare_fusion", cameras.fusion_jobs, cameras.fusion_figures, seeded=True),
    Step("grids", "grids of scanner and camera", "scripts/data_sets --low-level-fusion",
         cameras.grid_jobs, by_name),
    Step("stereo_grids", "stereo grids against the Velodyne", "evaluate stereo_grids",
         cameras.stereo_grid_jobs, only, (recordings.DRIVE_0005,)),
    Step("maps", "maps of low-level and map-level fusion, changes since a map was made",
         "evaluate maps, evaluate changes", maps.jobs, maps.figures, seeded=True),
    Step("mono", "a single camera: classes, tracks and grids", "run_bag --mono, evaluate classes",
         mono.jobs, mono.figures, (recordings.DRIVE_0005,), seeded=True),
    Step("wrong_classes", "wrong classes of a camera: classes of tracks, lost tracks",
         "simulate, run_bag --object-fusion, evaluate classes", wrong_classes.jobs,
         wrong_classes.figures, seeded=True),
    Step("risk", "risk of contact: encounters by all methods, false warnings", "scripts/encounters",
         risk.jobs, risk.figures),
    Step("robustness", "pose among moving vehicles", "scripts/robustness --seeds 5",
         measurements.robustness_jobs, by_name),
    Step("operating_curve", "missed frames against false tracks", "evaluate operating_curve",
         measurements.operating_curve_jobs, only, on_request=True),
    Step("speed", "speed and latency", "scripts/benchmark", measurements.speed_jobs, only,
         timed=True),
)  # fmt: skip
