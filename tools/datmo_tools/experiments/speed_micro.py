# SPDX-License-Identifier: BSD-3-Clause
"""Runs the hot paths under Google Benchmark, and extracts the relevant figures of its JSON."""

import json
import subprocess

from datmo_tools.errors import InputError

COUNTERS = ("per_pose", "median", "percentile_99")  # s, of a benchmark that counts them
MICROSECONDS = {"ns": 1e-3, "us": 1.0, "ms": 1e3, "s": 1e6}
REPETITIONS = 5  # the median is used


def measure(program, folder, quick=False):
    """Returns median times by benchmark (see `summarize`); `program`: benchmark_hot_paths."""
    output = folder / "micro.json"
    options = ["--benchmark_out_format=json", f"--benchmark_out={output}"]
    options += [f"--benchmark_repetitions={1 if quick else REPETITIONS}"]
    options += [f"--benchmark_min_time={0.001 if quick else 0.2}"]
    # So that other load of the machine affects a hot path and its limit alike.
    options += ["--benchmark_enable_random_interleaving=true"]
    done = subprocess.run([str(program), *options], check=False, stdout=subprocess.DEVNULL)
    if done.returncode != 0:
        raise InputError(f"{program}: failed with exit code {done.returncode}")
    return summarize(json.loads(output.read_text(encoding="utf-8")))


def summarize(report):
    """Returns name -> figures, from Google Benchmark's JSON: the median of the repetitions.

    CPU time, because others may use the machine meanwhile. A fitted growth is NAME/fit.
    """
    runs = {}
    for run in report["benchmarks"]:
        wanted = "iteration" if run.get("repetitions", 1) == 1 else "aggregate"
        if run.get("error_occurred"):
            raise InputError(f"{run['name']}: {run['error_message']}")
        aggregate = run.get("aggregate_name", "median")
        if aggregate in ("BigO", "RMS"):
            runs.setdefault(run["run_name"] + "/fit", {}).update(_fit(run))
        elif run["run_type"] == wanted and aggregate == "median":
            runs[run["run_name"]] = _figures(run)
    return dict(sorted(runs.items()))  # they ran interleaved


def _fit(run):
    """Returns a linear growth: time per unit, and the fit's error as a share of the mean time."""
    if run["aggregate_name"] == "RMS":
        return {"error": run["rms"]}
    return {"cpu_us": run["cpu_coefficient"] * MICROSECONDS[run["time_unit"]]}


def _figures(run):
    figures = {"cpu_us": run["cpu_time"] * MICROSECONDS[run["time_unit"]]}
    figures.update({f"{name}_us": run[name] * MICROSECONDS["s"] for name in COUNTERS if name in run})
    return figures
