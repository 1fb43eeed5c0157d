# SPDX-License-Identifier: BSD-3-Clause
"""Bounds on the effects of sensor faults, by drive and fault, which the campaign checks."""

from datmo_tools.errors import InputError
from datmo_tools.yaml_files import load_yaml

DEFAULT = "default"  # for the faults of a drive that are not named
REFUSED = "refused"  # nothing of the drive is usable, and this is reported
# In m, standard deviations of the pose, s after the fault's end, and of the drive without a fault.
BOUNDS = ("largest_error_m", "largest_error_sigmas", "recovered_s", "mota_loss")


def read_bounds(file):
    """Reads drive -> fault -> bound -> number (dictionaries) from a yaml file (Path); a null bound
    is none. Raises InputError."""
    bounds = load_yaml(file)
    if not isinstance(bounds, dict):
        raise InputError(f"{file}: expected drives with the bounds of their faults")
    for drive, faults in bounds.items():
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
    clean = without_fault["tracks"]["mota"]
    found = []
    for run in drive["runs"]:
        limits = of_drive.get(run["fault"], {})
        if limits != REFUSED:
            limits = {**of_drive[DEFAULT], **limits}
        found += [f"{drive['drive']}, {run['fault']}: {what}" for what in _beyond(run, limits, clean)]
    return found


def _beyond(run, limits, clean):
    if run["error"] is not None:
        return [] if limits == REFUSED and run["refused"] else [run["error"]]
    if limits == REFUSED:
        return ["was taken, expected that it is refused"]
    pose, mota = run["pose"], run["tracks"]["mota"]
    values = {
        **pose,
        "recovered_s": pose["recovered_s"] if pose["recovered"] else None,
        "mota_loss": None if mota is None or clean is None else clean - mota,
    }
    # NaN is beyond any bound.
    return [f"{name} {_text(values[name])}, expected at most {limit:g}"
            for name, limit in limits.items()
            if limit is not None and (values[name] is None or not values[name] <= limit)]  # fmt: skip


def _text(value):
    return "never known" if value is None else f"{value:.3f}"
