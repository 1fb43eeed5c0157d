# SPDX-License-Identifier: BSD-3-Clause
"""Step mono: KITTI's drive 0005 with a single camera, by detector, and the grids of its images."""

from functools import partial

from datmo_tools import programs
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.fusion_drives import LABELED, ODOMETRY_ERRORS
from datmo_tools.figures.class_figures import band_name, class_figures
from datmo_tools.figures.recordings import DRIVE_0005, VELODYNE_NOISE, drive_figures
from datmo_tools.figures.step import Job, preset

RESOLUTIONS = (2, 1)  # degrees between beams
# Of the scanner's objects, and from the image alone.
TOPICS = {"objects": "/objects/classes", "alone": "/objects/mono"}
ASKED = [word for topic in TOPICS.values() for word in ("--topic", topic)]
# Labels cover only the camera's view.
LABELED_VIEW = ("--visible-to", "none", "--half-angle", "0.7", "--range", "50")
NEAR = 20.0  # m, up to which grids are shown

NONE, HOG, DNN = "none", "hog", "dnn"
MODEL = "models/yolox_nano/yolox_nano.onnx"  # beside the recordings
# Grids of a vehicle without a stereo camera.
MONO_GRIDS = {"grid_fusion": {"sources": {"stereo": {"use": False}, "mono": {"use": True}}}}
GRIDS = ("lidar", "mono", "fused")


def jobs(bench):
    """Returns a job for each detector and resolution, and one for the grids; without the network's
    file it says so and leaves that out."""
    model = bench.data.parent / MODEL
    settings = {NONE: None, HOG: {"detector": HOG}, DNN: {"detector": DNN, "dnn": {"model": str(model)}}}
    if not model.is_file():
        print(f"mono: {DNN} left out, {model} is not there")
        del settings[DNN]
    return [Job("grids", partial(_grids, bench)),
            *(Job(f"{name}_{degrees}", partial(_run, bench, name, section, degrees))
              for degrees in RESOLUTIONS for name, section in settings.items())]  # fmt: skip


def figures(results):
    """Returns the grids' figures, and those of the runs by resolution and detector."""
    runs = {}
    for name, degrees, figure in results:
        if degrees is not None:
            runs.setdefault(f"{degrees}", {})[name] = figure
    ordered = {key: {name: runs[key][name] for name in (NONE, HOG, DNN) if name in runs[key]}
               for key in sorted(runs, reverse=True)}  # fmt: skip
    return {"runs": ordered, "grids": next(figure for _, degrees, figure in results if degrees is None)}


def _recorded(bench, folder, *words):
    recorded = folder / "drive.bag"
    bench.call("kitti_to_bag", bench.data / DRIVE_0005, recorded, "--images", *ODOMETRY_ERRORS, *words)
    return recorded


def _run(bench, name, section, degrees, folder):
    recorded = _recorded(bench, folder, "--scan-resolution", degrees)
    words = ("--mono", *preset(folder, {"mono_classifier": section})) if section else ()
    report = simulated_run.run_recorded(
        recorded, bench.programs, bench.config("kitti"), folder, (*LABELED, VELODYNE_NOISE), words,
        recorded)  # fmt: skip
    computed = folder / "result.bag"
    options = programs.settings(LABELED)
    classes = bench.evaluated(folder, "classes", computed, *options)["runs"][0]
    found = {
        **drive_figures(report),
        "id_switches": report["clear_mot"]["id_switches"],
        "delay_mean_s": report["delay"]["mean_s"],
        "class_right": {kind: item["right_share"] for kind, item in classes["classes"]["by_class"].items()},
        "tracks": class_figures(classes),
    }
    if section:
        scored = bench.evaluated(folder, "objects", computed, *ASKED, *LABELED_VIEW)
        found |= {key: class_figures(scored["topics"][topic]) for key, topic in TOPICS.items()}
    return name, degrees, found


def _grids(bench, folder):
    recorded, computed = _recorded(bench, folder, "--points"), folder / "result.bag"
    bench.call("run_bag", recorded, computed, "--config", bench.config("kitti"), "--quiet", "--mono",
               "--low-level-fusion", "--write-grids", *preset(folder, MONO_GRIDS))  # fmt: skip
    scores = {}
    for source in GRIDS:
        bands = bench.evaluated(folder, "free_cells", computed, recorded, "--topic", f"/grids/{source}")["bands"]
        scores[source] = {band_name(band["from"], band["to"]): {key: band[key] for key in ("precision", "recall")}
                          for band in bands if band["to"] <= NEAR and band["road"]}  # fmt: skip
    return "grids", None, scores
