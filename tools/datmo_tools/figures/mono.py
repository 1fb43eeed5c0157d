# SPDX-License-Identifier: BSD-3-Clause
"""Step mono: KITTI's drive 0005 with a single camera, without and with a network, and the grids of its images."""

from functools import partial

from datmo_tools import programs
from datmo_tools.evaluate.class_tally import BINS
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.fusion_drives import LABELED, ODOMETRY_ERRORS
from datmo_tools.figures.class_figures import band_name, class_figures
from datmo_tools.figures.network import network_of
from datmo_tools.figures.recordings import DRIVE_0005, VELODYNE_NOISE, drive_figures
from datmo_tools.figures.step import Job, preset
from datmo_tools.spread import spread, spread_of

RESOLUTIONS = (2, 1)  # degrees between beams
# There is one drive only: what differs from seed to seed is the noise of its odometry.
ODOMETRY_NOISE = ("--odometry-speed-noise", "0.05", "--odometry-yaw-noise", "0.3")  # m/s, deg/s

# Of the scanner's objects, and from the image alone.
TOPICS = {"objects": "/objects/classes", "alone": "/objects/mono"}
ASKED = [word for topic in TOPICS.values() for word in ("--topic", topic)]
# Labels cover only the camera's view.
LABELED_VIEW = ("--visible-to", "none", "--half-angle", "0.7", "--range", "50")
SPREAD = ("mota", "id_switches", "false_movers_per_frame", "brief", "delay_mean_s")
LASTING = ("cyclist", "vehicle")  # those that are there for the whole drive
NEAR = 20.0  # m, up to which grids are shown

NONE, DNN = "none", "dnn"
# Grids of a vehicle without a stereo camera.
MONO_GRIDS = {"grid_fusion": {"sources": {"stereo": {"use": False}, "mono": {"use": True}}}}
GRIDS = ("lidar", "mono", "fused")


def jobs(bench):
    """Returns a job for each resolution and seed, and one for the grids; without the network's file it
    says so and leaves that out."""
    detectors = {NONE: ()}
    if network := network_of(bench, "mono"):
        detectors[DNN] = {"detector": DNN, "dnn": {"model": str(network)}}
    return [Job("grids", partial(_grids, bench)),
            *(Job(f"{degrees}_{seed}", partial(_runs, bench, detectors, degrees, seed))
              for degrees in RESOLUTIONS for seed in bench.seeds)]  # fmt: skip


def figures(results):
    """Returns the grids' figures, and those of the runs by resolution and detector, over the seeds."""
    runs = {}
    for degrees, found in results:
        if degrees is not None:
            for name, figure in found.items():
                runs.setdefault(f"{degrees}", {}).setdefault(name, []).append(figure)
    ordered = {f"{degrees}": {name: _over_seeds(several) for name, several in runs[f"{degrees}"].items()}
               for degrees in RESOLUTIONS}  # fmt: skip
    return {"runs": ordered, "grids": next(found for degrees, found in results if degrees is None)}


def _over_seeds(runs):
    """Returns the spread of each figure, and the sums of the reported classes."""
    classes = {key: pooled([run[key] for run in runs]) for key in ("tracks", *TOPICS) if key in runs[0]}
    return {**spread_of([{key: run[key] for key in SPREAD} for run in runs]), **classes,
            "class_right": {kind: spread([run["class_right"].get(kind) for run in runs])
                            for kind in LASTING}}  # fmt: skip


def pooled(several):
    """Returns class_figures of several runs as if they were one."""
    bins = {}
    for said, right, count in (item for one in several for item in one["calibration"]):
        bins.setdefault(min(int(said * BINS), BINS - 1), []).append((said, right, count))
    first = several[0]
    return {
        "right": {kind: {band: [sum(one["right"][kind][band][k] for one in several) for k in range(2)]
                         for band in first["right"][kind]} for kind in first["right"]},
        "reported": sum(one["reported"] for one in several),
        "on_nothing": sum(one["on_nothing"] for one in several),
        "calibration": [_mean(bins[k]) for k in sorted(bins)],
    }  # fmt: skip


def _mean(rows):
    """Returns [said, right, count] of several rows, weighted by their counts."""
    count = sum(row[2] for row in rows)
    return [*(sum(row[k] * row[2] for row in rows) / count for k in range(2)), count]


def _recorded(bench, folder, *words):
    recorded = folder / "drive.bag"
    bench.call("kitti_to_bag", bench.data / DRIVE_0005, recorded, "--images", *ODOMETRY_ERRORS, *words)
    return recorded


def _runs(bench, detectors, degrees, seed, folder):
    recorded = _recorded(bench, folder, "--scan-resolution", degrees, *ODOMETRY_NOISE, "--seed", seed)
    return degrees, {name: _run(bench, recorded, section, folder) for name, section in detectors.items()}


def _run(bench, recorded, section, folder):
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
    return found


def _grids(bench, folder):
    recorded, computed = _recorded(bench, folder, "--points"), folder / "result.bag"
    bench.call("run_bag", recorded, computed, "--config", bench.config("kitti"), "--quiet", "--mono",
               "--low-level-fusion", "--write-grids", *preset(folder, MONO_GRIDS))  # fmt: skip
    scores = {}
    for source in GRIDS:
        bands = bench.evaluated(folder, "free_cells", computed, recorded, "--topic", f"/grids/{source}")["bands"]
        scores[source] = {band_name(band["from"], band["to"]): {key: band[key] for key in ("precision", "recall")}
                          for band in bands if band["to"] <= NEAR and band["road"]}  # fmt: skip
    return None, scores
