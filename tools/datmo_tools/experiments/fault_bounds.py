# SPDX-License-Identifier: BSD-3-Clause
"""Bounds on the effects of sensor faults, by drive and fault, which the campaign checks."""

import numpy as np

from datmo_tools.errors import InputError
from datmo_tools.yaml_files import load_yaml

DEFAULT = "default"  # for the faults of a drive that are not named
REFUSED = "refused"  # nothing of the drive is usable, and this is reported
# In m, standard deviations of the pose, s after the fault's end, and relative to the drive without a fault.
BOUNDS = ("largest_error_m", "largest_error_sigmas", "recovered_s", "mota_loss", "added_false_positives", "added_id_switches")
# One scanner silent for a while, in a drive with a stereo camera: of each level of fusion, over all times.
SILENT = "silent scanner"
SILENT_BOUNDS = ("share_of_distance", "lost_ids")


def read_bounds(file):
    """Reads drive -> fault -> bound -> number (dictionaries), and SILENT -> bound -> number, from a
    yaml file (Path); a null bound is none. Raises InputError."""
    bounds = load_yaml(file)
    if not isinstance(bounds, dict) or set(bounds.get(SILENT) or ()) != set(SILENT_BOUNDS):
        raise InputError(f"{file}: expected drives with the bounds of their faults, and '{SILENT}' with {', '.join(SILENT_BOUNDS)}")
    for drive, faults in bounds.items():
        if drive == SILENT:
            continue
        if not isinstance(faults, dict) or set(faults.get(DEFAULT, {})) != set(BOUNDS):
            raise InputError(f"{file}: {drive}: expected faults, and {DEFAULT} with {', '.join(BOUNDS)}")
        for fault, limits in faults.items():
            if limits != REFUSED and not (isinstance(limits, dict) and set(limits) <= set(BOUNDS)):
                raise InputError(f"{file}: {drive}: {fault}: expected {REFUSED}, or some of {', '.join(BOUNDS)}")
    return bounds


def beyond(drive, bounds):
    """Returns what a drive's results (dict of the campaign) have beyond its bounds (of
    read_bounds): list of str. Raises InputError if the drive has no bounds."""
    if drive["drive"] not in bounds:
        raise InputError(f"no bounds of {drive['drive']}, expected those of all its faults")
    of_drive = bounds[drive["drive"]]
    without_fault = drive["runs"][0]
    if without_fault["error"] is not None:  # nothing to compare with
        return [f"{drive['drive']}, {without_fault['fault']}: {without_fault['error']}"]
    clean = without_fault["tracks"]
    found = []
    for run in drive["runs"]:
        limits = of_drive.get(run["fault"], {})
        if limits != REFUSED:
            limits = {**of_drive[DEFAULT], **limits}
        found += [f"{drive['drive']}, {run['fault']}: {what}" for what in _beyond(run, limits, clean)]
    return found


def beyond_silent(runs, bounds):
    """Returns what the runs (list of dict of the campaign) with a silent scanner have beyond their
    bounds (of read_bounds), or why they failed: list of str."""
    found = [f"{run['level']}, scan silent from {run['from_s']:g} s: {run['error']}"
             for run in runs if run["error"] is not None]  # fmt: skip
    done = [run for run in runs if run["error"] is None]
    for level in dict.fromkeys(run["level"] for run in done):
        of_level = [run for run in done if run["level"] == level]
        # Without a pose after the silence, the error counts as infinite.
        shares = [np.inf if run["settled_m"] is None else run["settled_m"] / run["distance_m"] for run in of_level]
        values = {"share_of_distance": max(shares), "lost_ids": sum(run["tracked"] - run["kept"] for run in of_level)}
        found += [f"{level}, scan silent: {name} {_text(values[name])}, expected at most {limit:g}"
                  for name, limit in bounds[SILENT].items() if limit is not None and not values[name] <= limit]  # fmt: skip
    return found


def _beyond(run, limits, clean):
    if run["error"] is not None:
        return [] if limits == REFUSED and run["refused"] else [run["error"]]
    if limits == REFUSED:
        return ["was taken, expected that it is refused"]
    pose, tracks = run["pose"], run["tracks"]
    values = {
        **pose,
        "recovered_s": pose["recovered_s"] if pose["recovered"] else None,
        "mota_loss": _added(clean["mota"], tracks["mota"]),
        "added_false_positives": _added(tracks["false_positives"], clean["false_positives"]),
        "added_id_switches": _added(tracks["id_switches"], clean["id_switches"]),
    }
    # NaN is beyond any bound.
    return [f"{name} {_text(values[name])}, expected at most {limit:g}"
            for name, limit in limits.items()
            if limit is not None and (values[name] is None or not values[name] <= limit)]  # fmt: skip


def _added(value, to):
    """Returns value - to; None if one of them is."""
    return None if value is None or to is None else value - to


def _text(value):
    if value is None:
        return "never known"
    return str(value) if isinstance(value, int) else f"{value:.3f}"
