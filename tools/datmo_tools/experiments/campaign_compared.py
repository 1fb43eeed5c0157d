# SPDX-License-Identifier: BSD-3-Clause
"""Renders the part of the campaign's page that sets its figures beside what Autoware and PX4 promise
and test: the statements on both are fixed, with their sources, in campaign_compared.md.jinja."""

from pathlib import Path

import jinja2

from datmo_tools.experiments.soak import of_stack
from datmo_tools.text_table import rounded

NAME = "campaign_compared.md.jinja"
NOT_RUN = "(not run)"
FAULTS = {
    "clean": "none",
    "silent": "scan silent for 3 s",
    "frozen": "scan frozen for 3 s",
    "late": "scan late by 1 s for 5 s",
    "clock": "scan clock 0.1 s ahead for 5 s",
    "always": "scan clock always 0.1 s ahead",
    "stray": "scan stamp 1e6 s ahead once",
    "looped": "all clocks back by 100 s (a looped bag)",
    "fast": "odometry 100 m/s once",
}
# Outages of no single nodelet.
NOTHING, PROCESS = "nothing", "the process killed"


def compared(report):
    """Returns the part (Markdown) for a report (dict), with the faults of its first drive."""
    drive = report["drives"][0]
    runs = {run["fault"]: run for run in drive["runs"]}
    parts = {key: line(report[key]) if report[key] else NOT_RUN
             for key, line in (("mutated", _mutated), ("outages", _outages), ("load", _load), ("soak", _soak))}  # fmt: skip
    figures = {key: _fault(runs.get(fault)) for key, fault in FAULTS.items()}
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(str(Path(__file__).parent)),
                                     undefined=jinja2.StrictUndefined, autoescape=False)  # fmt: skip
    return environment.get_template(NAME).render(drive=drive["drive"], **figures, **parts)


def _fault(run):
    """Formats the largest error and the MOTA (no score: left out) of one drive with a fault."""
    if run is None:
        return NOT_RUN
    if run["error"] is not None or run["pose"]["largest_error_m"] is None:
        return "(no result)"
    mota = run["tracks"]["mota"]
    score = "" if mota is None else f", {mota:.3f}"
    return f"{run['pose']['largest_error_m']:.2f} m{score}"


def _mutated(mutated):
    return f"{mutated['mutated']} messages with corrupted fields, in {mutated['drives']} drives; faults found: {len(mutated['faults'])}"


def _outages(outages):
    single = [each for each in outages if each["what"] not in (NOTHING, PROCESS)]
    judged = [each["id_kept"] for each in single if each["id_kept"] is not None]
    lines = []
    if single:
        loaded, tracks = (max(each[key] for each in single) for key in ("loaded_s", "tracks_s"))
        lines.append(f"Each of {len(single)} nodelets, unloaded, is loaded again within {loaded:.1f} s, with tracks "
                     f"within {tracks:.1f} s; a track keeps its id in {sum(judged)} of {len(judged)} cases")  # fmt: skip
    lines += [f"a killed process has tracks again after {each['tracks_s']:.1f} s"
              for each in outages if each["what"] == PROCESS]  # fmt: skip
    return "; ".join(lines) or NOT_RUN


def _load(load):
    times = [f"{rounded(load[key]['median_s'], 2)} s ({rounded(load[key]['percentile_99_s'], 2)} s)"
             for key in ("load", "nominal")]  # fmt: skip
    return f"Scan to tracks, median (99 %), at three times the rates: {times[0]} instead of {times[1]}"


def _soak(soaked):
    stack = of_stack(soaked["samples"])
    growth = stack["heap_mib"]
    return (f"{stack['hours']:.1f} hours: allocated memory grows by {growth['per_hour']:.2f} +- {growth['error']:.2f} MiB "
            f"an hour, {stack['dropped']} messages dropped")  # fmt: skip
