# SPDX-License-Identifier: BSD-3-Clause
"""Step risk: encounters after public test protocols by all methods, and false warnings in dense traffic."""

from functools import partial

from datmo_tools.evaluate.risk import score_of
from datmo_tools.evaluate.thesis_tables import PUBLISHED
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.encounters import METHODS, OWN, RESULT, TRUE
from datmo_tools.figures.step import Job, read_json

OURS = METHODS[0]
RELIABILITY = "4"  # s within which contact is said, for the diagram
TRAFFIC = "traffic"  # the simulated data sets, one seed


def jobs(bench):
    """A job for the encounters by each kind of tracks, and one for each data set."""
    drives = [Job(f"{TRAFFIC}_{number}", partial(_traffic, bench, number))
              for number in range(len(PUBLISHED), 0, -1)]  # fmt: skip
    return [*drives, *(Job(tracks, partial(_encounters, bench, tracks)) for tracks in (OWN, TRUE))]


def figures(results):
    """By kind of tracks and method; of the data sets together the warnings and their duration."""
    found = {name: figure for name, figure in results if name != TRAFFIC}
    drives = [figure for name, figure in results if name == TRAFFIC]
    found[TRAFFIC] = {key: sum(drive[key] for drive in drives) for key in ("warnings", "seconds")}
    return found


def _encounters(bench, tracks, folder):
    bench.experiment("encounters", folder, "--programs", bench.programs, "--tracks", tracks,
                     "--config", bench.config("demonstrator"))  # fmt: skip
    scored = read_json(folder / RESULT)[tracks]
    return tracks, {method: _of_method(scored[method], method == OURS) for method in METHODS}


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
    recorded, computed = folder / "drive.bag", folder / "result.bag"
    simulated_run.record(simulated_run.SimulatedDrive(bench.scene(f"data_set_{number}")),
                         bench.programs, recorded)  # fmt: skip
    bench.call("run_bag", recorded, computed, "--config", bench.config("demonstrator"),
               "--road-border", "--risk", "--with-truth", "--quiet")  # fmt: skip
    scored = score_of([computed])
    return TRAFFIC, {"warnings": scored["false_warnings"], "seconds": 3600.0 * scored["hours"]}
