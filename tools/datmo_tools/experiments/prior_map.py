# SPDX-License-Identifier: BSD-3-Clause
"""Maps the first part of a drive, and tests localization in this map: command line and runs."""

import math
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from tqdm import tqdm

from datmo_tools import command_line, programs, transforms
from datmo_tools.bag_file import whole_bag
from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError
from datmo_tools.experiments.map_coverage import MapSurfaces, known_shares
from datmo_tools.pose_path import POSE_OF, planar, read_messages, read_path
from datmo_tools.stamps import NANOSECONDS, to_ros_time
from datmo_tools.text_table import aligned

DESCRIPTION = """\
Makes a map of the first part of a recorded drive, saves it, and starts the vehicle in it, at
regular times of the rest of the drive, without an initial pose. Prints how often it was localized
in time, how often at a wrong position, and the error of the pose; and the same by the share of the
vehicle's view in that time that is in the map, since a place that the first part of the drive did
not see cannot be recognized: the starts in the map are the attainable ones. Reference: the poses of
one run over the whole drive, whose map is the same. The exit code is 1 if there was a wrong
localization."""

FORMAT = 1  # of the JSON file
PROGRAMS = ("run_bag",)
STATIC = "/tf_static"  # latched: all of it counts from the start
# m: a pose claims to be located if its standard deviation is below this; before, it has meters.
LOCATED_SIGMA = 1.0
# A pose is wrong from these errors on.
WRONG_POSITION = 0.5  # m
WRONG_HEADING = 5.0  # degrees
# Bounds of the table's groups of starts: mean shares of the scans' end points that the map covers.
# In the first group a pose can be found, in the last one hardly.
KNOWN_SHARES = (1.0, 0.9, 0.8, 0.5, 0.0)


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    results = []
    code = command_line.run("prior_map", lambda: results.append(_run(values)), "report")
    return code or int(any(one["wrong"] for one in results[0]))


def cut(recorded, begin, end, written):
    """Writes all topics of a drive (Path) between two stamps (ns) to a bag (Path)."""
    with opened(recorded) as bag, whole_bag(written, "prior_map") as out:
        for topic, message, _ in bag.read_messages([STATIC]):
            out.write_latched(topic, begin, message)
        span = [to_ros_time(begin), to_ros_time(end)]
        for message in bag.read_messages(None, *span, raw=True, return_connection_header=True):
            if message.topic != STATIC:
                out.copy(message)


def score(computed, reference, begin):
    """Returns the result (dict) of a start at `begin` (ns) by the poses in the bag `computed`
    (Path).

    reference: PosePath in the same map. found_after: s, None if no pose claimed to be located.
    wrong: whether any pose that did was off; errors are those of the last pose.
    """
    found_after, wrong, last = None, False, None
    for message, kind in read_messages(computed, "/pose/local"):
        sigma = math.sqrt(max(message.pose.covariance[0], message.pose.covariance[7]))
        if sigma > LOCATED_SIGMA:
            continue
        stamp = message.header.stamp.to_nsec()
        error = transforms.relative(reference.at(stamp), planar(POSE_OF[kind](message)))
        last = float(np.hypot(error[0], error[1])), abs(math.degrees(error[2]))
        if found_after is None:
            found_after = (stamp - begin) / NANOSECONDS
        wrong = wrong or last[0] > WRONG_POSITION or last[1] > WRONG_HEADING
    return {
        "found_after_s": found_after,
        "wrong": wrong,
        "position_m": last and last[0],
        "heading_deg": last and last[1],
    }


def table(results, within):
    """Formats the results (list of dict). within: s, in which a vehicle is to be localized."""
    rows = [["starts", "", f"found within {within:g} s", "found", "wrong place",
             "found after, s: median", "off at the end, m: median", "max", "deg: median",
             "max"]]  # fmt: skip
    rows.append(_row("all", results, within))
    for upper, lower in zip(KNOWN_SHARES, KNOWN_SHARES[1:]):
        group = [one for one in results if lower <= _known_share(one) < upper]
        name = f"{100 * lower:g} to {100 * upper:g} % of the view in the map"
        rows.append(_row(name, group, within))
    return aligned(rows)


def _known_share(result):
    """Returns a start's share, below 1: a view that is all in the map is in the first group."""
    return min(result["known_share"], np.nextafter(1.0, 0.0))


def _row(name, results, within):
    found = [one for one in results if one["found_after_s"] is not None]
    right = [one for one in found if not one["wrong"]]
    in_time = [one for one in right if one["found_after_s"] <= within]
    figures = [_median([one["found_after_s"] for one in right])]
    for key in ("position_m", "heading_deg"):
        errors = [one[key] for one in right]
        figures += [_median(errors), max(errors, default=math.nan)]
    return [name, *(str(len(ones)) for ones in (results, in_time, right)),
            str(len(found) - len(right)), *(f"{figure:.3f}" for figure in figures)]  # fmt: skip


def _median(values):
    return float(np.median(values)) if values else math.nan


def _run_bag(values, *words):
    programs.call(values.programs / "run_bag", *words, "--config", values.config, "--until",
                  "grid_slam", "--quiet")  # fmt: skip


def _start(values, saved, reference, begin):
    """Returns the result (dict) of one start at `begin` (ns). Raises StepFailed."""
    with tempfile.TemporaryDirectory(prefix="prior_map_") as name:
        drive, computed = Path(name) / "drive.bag", Path(name) / "result.bag"
        cut(values.drive, begin, begin + round(values.seconds * NANOSECONDS), drive)
        _run_bag(values, drive, computed, "--map", saved)
        return {"begin_s": begin / NANOSECONDS, **score(computed, reference, begin)}


def _run(values):
    """Returns a list of results (dict), one per start."""
    for file in (values.drive, values.config):
        if not file.is_file():
            raise InputError(f"{file}: no such file, expected a bag and a yaml file")
    programs.check(values.programs, PROGRAMS)
    with tempfile.TemporaryDirectory(prefix="prior_map_") as name:
        folder = Path(name)
        try:
            results = _starts(values, folder)
        except programs.StepFailed as error:
            raise InputError(str(error)) from error
    print(table(results, values.within))
    command_line.write_json(values.out, {"format": FORMAT, "drive": values.drive.name, "starts": results})
    return results


def _starts(values, folder):
    whole, first, saved = (folder / file for file in ("whole.bag", "first.bag", "first.map"))
    _run_bag(values, values.drive, whole)
    reference = read_path(whole, "/pose")
    begin, end = int(reference.stamps[0]), int(reference.stamps[-1])
    middle = begin + round(values.share * (end - begin))
    cut(values.drive, begin, middle, first)
    _run_bag(values, first, folder / "mapped.bag", "--save-map", saved)
    last = end - round(values.seconds * NANOSECONDS)
    stamps = [int(stamp) for stamp in np.linspace(middle, last, values.starts)]
    scans, known = known_shares(whole, middle, MapSurfaces(saved.with_suffix(".yaml")))
    with ThreadPoolExecutor(values.jobs) as pool:
        runs = pool.map(lambda stamp: _start(values, saved, reference, stamp), stamps)
        results = list(tqdm(runs, total=len(stamps), desc="starts", disable=None))
    for one, stamp in zip(results, stamps):
        seen = known[(scans >= stamp) & (scans <= stamp + round(values.within * NANOSECONDS))]
        one["known_share"] = float(seen.mean()) if len(seen) else 0.0
    return results


def _parser():
    parser = command_line.new_parser("prior_map", DESCRIPTION)
    add = parser.add_argument
    add("drive", type=Path, metavar="DRIVE.bag", help="recording, as for run_bag")
    add("--config", required=True, type=Path, metavar="CONFIG.yaml", help="the sensor set")
    add("--programs", required=True, type=Path, metavar="DIR", help="of run_bag")
    add("--starts", type=command_line.count, default=100, metavar="N",
        help="number of starts (default 100)")  # fmt: skip
    add("--jobs", type=command_line.count, default=1, metavar="N",
        help="parallel runs (default 1)")  # fmt: skip
    add("--out", type=command_line.output_file, metavar="FILE.json", help="all starts")
    command_line.add_number(parser, "--share", 0.5, "X", "share of the drive that is mapped")
    command_line.add_number(parser, "--seconds", 15.0, "S", "length of a run")
    command_line.add_number(parser, "--within", 10.0, "S", "time for it to be localized")
    return parser
