# SPDX-License-Identifier: BSD-3-Clause
"""Step wrong_classes: a simulated camera that reports a wrong class in a stated share of its images:
the classes of the tracks, and whether tracks are lost."""

from functools import partial

from datmo_tools import programs
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.data_sets import SCORE_OPTIONS
from datmo_tools.figures.class_figures import class_figures
from datmo_tools.figures.step import Job, preset
from datmo_tools.spread import pooled_counts, spread_of

SCENE = "data_set_2"
DURATION = "duration=75"  # s: past the intersection, where most of its objects move
WRONG = (0.0, 0.1, 0.2, 0.4)  # shares of a camera's reports
SCANNER = "scanner alone"
# The camera's objects come from the drive.
CAMERA = {"object_fusion": {"sources": {"stereo": {"use": False}, "mono": {"use": True}}}}
COUNTS = ("required", "misses", "false_positives", "id_switches")


def jobs(bench):
    """Returns a job for each seed."""
    return [Job(f"{seed}", partial(_measure, bench, seed)) for seed in bench.seeds]


def figures(results):
    """Returns the spread over the seeds, without the camera and by the share of wrong classes."""
    return spread_of(results)


def confusion(wrong):
    """Returns the simulator's option for a detector that reports each of the two wrong classes of an
    object in half of this share of the images, and never misses it."""
    rows = [[1.0 - wrong if said == true else wrong / 2.0 for said in range(3)] for true in range(3)]
    return f"mono/confusion={sum(rows, [])}"


def _measure(bench, seed, folder):
    camera = ("--object-fusion", *preset(folder, CAMERA))
    found = {}
    for wrong in WRONG:
        options = (f"seed={seed}", DURATION, "mono/enabled=true", confusion(wrong))
        recorded = folder / "drive.bag"
        simulated_run.record(simulated_run.SimulatedDrive(bench.scene(SCENE), options), bench.programs, recorded)
        if not found:
            found[SCANNER] = _run(bench, recorded, folder, ())
        found[f"{wrong:g}"] = _run(bench, recorded, folder, camera)
    return found


def _run(bench, recorded, folder, words):
    report = simulated_run.run_recorded(recorded, bench.programs, bench.config("demonstrator"), folder,
                                        SCORE_OPTIONS, ("--road-border", *words))  # fmt: skip
    classes = bench.evaluated(folder, "classes", folder / "result.bag", *programs.settings(SCORE_OPTIONS))
    return {
        **pooled_counts([report["clear_mot"]], COUNTS),
        "missed_objects": report["thesis"]["missed_objects"],
        "moving_objects": report["thesis"]["moving_objects"],
        "class_right": report["classes"]["right_share"],
        "class_right_by_range": right_by_range(class_figures(classes["runs"][0])["right"]),
    }


def right_by_range(right):
    """Returns by range which share of the classes is right; None: there are none.

    right: true class -> range -> [right ones, all]
    """
    shares = {}
    for band in next(iter(right.values())):
        hits, count = (sum(bands[band][k] for bands in right.values()) for k in range(2))
        shares[band] = hits / count if count else None
    return shares
