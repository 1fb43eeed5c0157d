# SPDX-License-Identifier: BSD-3-Clause
"""Measures the error of the pose at the end of a drive, with and without loop closing, and how many
loops are false: command line and runs."""

import json
import math
import tempfile
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

from datmo_tools import command_line, programs, transforms
from datmo_tools.errors import InputError
from datmo_tools.experiments import simulated_run
from datmo_tools.pose_path import read_path
from datmo_tools.stamps import NANOSECONDS
from datmo_tools.text_table import aligned, rounded

DESCRIPTION = """\
Drives a scene through simulator and run_bag, with several seeds, and prints the final and the
largest error of the live pose and of the optimized trajectory, both aligned with the true drive at
the first pose; how many loops were closed, and how many of these are false; and the time per scan."""

FORMAT = 2  # of the JSON file
PROGRAMS = ("simulate", "run_bag")
TRAJECTORY = "/trajectory/optimized"
PATHS = {"live pose": "/pose", "with loops closed": TRAJECTORY}

# A loop with a larger error is false: more than a match within one cell of the map explains.
FALSE_M = 0.5
FALSE_DEG = 2.0


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run("loop_closing", lambda: _run(values), product="report")


def errors(path, truth):
    """Returns the error of a PosePath against the true one (PosePath), aligned at the path's first
    stamp: dict of end_m, end_deg, end_share (of the distance driven), max_m."""
    begin = path.stamps[0]
    to_truth = transforms.compose(
        truth.at(begin), transforms.relative(path.at(begin), np.zeros(3))
    )
    apart = np.array([
        transforms.relative(truth.at(stamp), transforms.compose(to_truth, pose))
        for stamp, pose in zip(path.stamps, path.poses)
    ])  # fmt: skip
    distances = np.hypot(apart[:, 0], apart[:, 1])
    return {
        "end_m": float(distances[-1]),
        "end_deg": abs(math.degrees(apart[-1, 2])),
        "end_share": float(distances[-1]) / truth.length(),
        "max_m": float(distances.max()),
    }


def loop_errors(loops, start, truth):
    """Returns errors of loops (list of dict, of run_bag's report) by a PosePath: list of (m, deg).

    start: stamp (ns) that the loops' times are relative to.
    """
    found = []
    for loop in loops:
        begin, end = (truth.at(start + round(loop[key] * NANOSECONDS)) for key in ("from_s", "to_s"))
        motion = np.array([loop["x_m"], loop["y_m"], loop["heading_rad"]])
        apart = transforms.relative(transforms.relative(begin, end), motion)
        found.append((float(math.hypot(apart[0], apart[1])), abs(math.degrees(apart[2]))))
    return found


def loop_figures(loops, start, truth):
    """Summarizes loops (dict, from run_bag's report), with the number of false ones: dict."""
    off = loop_errors(loops["closed"], start, truth)
    return {
        **loops,
        "closed": len(off),
        "false": sum(position > FALSE_M or turn > FALSE_DEG for position, turn in off),
        "max_m": max((position for position, _ in off), default=None),
        "max_deg": max((turn for _, turn in off), default=None),
    }


def table(results):
    """Formats the results (list of dict, one per seed)."""
    rows = [["seed", "", "off at the end, m", "% of the distance", "deg", "at the most, m",
             "loops", "false", "at the most off, m", "deg"]]  # fmt: skip
    for result in results:
        for name in PATHS:
            scored = result[name]
            figures = scored["end_m"], 100.0 * scored["end_share"], scored["end_deg"]
            loops = result["loops"] if name == "with loops closed" else None
            rows.append([str(result["seed"]), name, *(f"{figure:.3f}" for figure in figures),
                         f"{scored['max_m']:.2f}", *_loop_cells(loops)])  # fmt: skip
    times = {stage: np.mean([result["time"][stage]["mean_s"] for result in results])
             for stage in ("grid_slam", "loop_closing")}  # fmt: skip
    notes = [f"{stage}: {1e3 * mean:.2f} ms a scan" for stage, mean in times.items()]
    return "\n".join([aligned(rows), *notes])


def _loop_cells(loops):
    if loops is None:
        return [""] * 4
    return [str(loops["closed"]), str(loops["false"]),
            rounded(loops["max_m"], 2), rounded(loops["max_deg"], 2)]  # fmt: skip


def _drive(values, seed):
    """Returns the result (dict) of one seed. Raises StepFailed."""
    with tempfile.TemporaryDirectory(prefix="loop_closing_") as name:
        folder = Path(name)
        recorded, computed = folder / "in.bag", folder / "out.bag"
        times, report = folder / "times.json", folder / "report.json"
        drive = simulated_run.SimulatedDrive(values.scene, (f"seed={seed}",))
        simulated_run.record(drive, values.programs, recorded)
        programs.call(values.programs / "run_bag", recorded, computed, "--config", values.config,
                      "--loop-closing", "--until", "loop_closing", "--times", times,
                      "--report", report, "--quiet")  # fmt: skip
        truth = read_path(recorded, "/ground_truth/pose")
        scored = {kind: errors(read_path(computed, topic), truth) for kind, topic in PATHS.items()}
        found = json.loads(report.read_text(encoding="utf-8"))
        loops = loop_figures(found["loops"], round(found["start_s"] * NANOSECONDS), truth)
        time = json.loads(times.read_text(encoding="utf-8"))
        return {"seed": seed, **scored, "loops": loops, "time": time}


def _run(values):
    for file in (values.scene, values.config):
        if not file.is_file():
            raise InputError(f"{file}: no such file, expected a scene and a yaml file")
    programs.check(values.programs, PROGRAMS)
    with ThreadPoolExecutor(values.jobs) as pool:
        try:
            results = list(pool.map(partial(_drive, values), range(1, values.seeds + 1)))
        except programs.StepFailed as error:
            raise InputError(str(error)) from error
    print(table(results))
    command_line.write_json(values.out, {"format": FORMAT, "scene": values.scene.stem, "results": results})


def _parser():
    parser = command_line.new_parser("loop_closing", DESCRIPTION)
    add = parser.add_argument
    add("scene", type=Path, metavar="SCENE.yaml",
        help="scene of the simulator: a closed course, or one without loops")  # fmt: skip
    add("--programs", type=Path, required=True, metavar="FOLDER", help="of simulate and run_bag")
    add("--config", type=Path, required=True, metavar="FILE.yaml", help="the sensor set")
    add("--seeds", type=int, default=3, metavar="N", help="number of seeds (default %(default)s)")
    add("--jobs", type=int, default=1, metavar="N", help="parallel runs (default %(default)s)")
    add("--out", type=command_line.output_file, metavar="FILE.json", help="for all figures")
    return parser
