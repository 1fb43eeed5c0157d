# SPDX-License-Identifier: BSD-3-Clause
"""evaluate borders."""

from pathlib import Path
from typing import NamedTuple

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate.arguments import add_truth
from datmo_tools.evaluate.border_errors import frames_of, samples_of
from datmo_tools.evaluate.border_lists import read_borders
from datmo_tools.evaluate.border_table import sections
from datmo_tools.evaluate.border_tally import BANDS, tally
from datmo_tools.evaluate.false_borders import score_false
from datmo_tools.evaluate.parked_rows import RowOptions
from datmo_tools.evaluate.true_road import TrueRoad

DESCRIPTION = """\
Scores the road borders (/road_borders of run_bag --road-border; thesis 3.5) against the truth
of a drive. The evaluated part is the road that the vehicle drives, from 10 m behind it to 40 m
ahead along its true path, every half meter, outside of junctions and not around a corner of more
than 60 degrees; the run's map is aligned with the truth at the vehicle's pose, so that its drift
does not count.

  true border  the end of the drivable road: the curb, or the line of the road-side faces of the
               vehicles parked along it throughout, bridged over gaps of up to --bridged. In a
               gap longer than --car-length, and this far beyond the ends of a row, curb and row are
               both right: the one closer to the published border counts
  found        share of the true stations, seen before or not, with a published border within
               --found-within of the true one
  error        of published borders across the true one, positive: too far out. Those farther off
               than --gate are excluded and counted separately; from the curb: the
               same error relative to the plain curb
  NEES         square of the error over the published variance: 1 in the mean and 0.45 in
               the median if it is consistent, and then 95 % are within the gate
  false        borders within 40 m that are more than --false-from from any curb, parked vehicle
               and row: on the road, in a junction, beyond the true border, or where none is known

A road is a curve if its curb's radius is less than --curve-radius. Intersections are scored by
evaluate tracks."""

GATE = 3.0  # m
FOUND_WITHIN = 1.0  # m
FALSE_FROM = 1.5  # m
CURVE_RADIUS = 300.0  # m


class Limits(NamedTuple):
    """Options of the score."""

    gate: float = GATE  # m, a border farther off is not of this road
    found_within: float = FOUND_WITHIN  # m, of the true border
    false_from: float = FALSE_FROM  # m, from everything that ends a road
    curve_radius: float = CURVE_RADIUS  # m
    rows: RowOptions = RowOptions()


def score(run, drive=None, limits=Limits()):
    """Returns the score of the borders in the bag `run` (Path) as a dictionary that JSON can hold.

    drive: bag with the truth (Path), by default `run`. Raises InputError, also if nothing can be
    scored.
    """
    drive = drive or run
    lists = read_borders(run)
    road = TrueRoad(drive, limits.rows, limits.curve_radius)
    frames = frames_of(run, lists, road)
    if not frames:
        raise InputError(f"{run}: no list of borders has a stamp near one of truth and pose")
    return {
        "run": str(run), "drive": str(drive),
        "lists": len(frames), "without_truth": len(lists) - len(frames),
        "gate_m": limits.gate, "found_within_m": limits.found_within,
        "false_from_m": limits.false_from, "curve_radius_m": limits.curve_radius,
        "bridged_m": limits.rows.bridged, "car_length_m": limits.rows.car_length,
        "bands_m": [list(band) for band in BANDS],
        "borders": tally(samples_of(frames, road), limits.gate, limits.found_within),
        "false": score_false(frames, road, limits.false_from),
    }  # fmt: skip


def evaluate(values):
    """Returns the score and its sections. Raises InputError."""
    command_line.check_positive(
        values, "gate", "found_within", "false_from", "curve_radius", "car_length")  # fmt: skip
    command_line.check_not_negative(values, "bridged")
    rows = RowOptions(values.bridged, values.car_length)
    limits = Limits(values.gate, values.found_within, values.false_from, values.curve_radius, rows)
    result = score(values.run, values.truth, limits)
    return result, sections(result)


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("run", type=Path, metavar="RUN.bag", help="bag of run_bag --road-border")
    add_truth(parser)
    for name, default, text in (
        ("--gate", GATE, "distance from the true border beyond which no error counts, m"),
        ("--found-within", FOUND_WITHIN, "distance within which the true border is found, m"),
        ("--false-from", FALSE_FROM, "farther from all that ends a road, a border is false, m"),
        ("--curve-radius", CURVE_RADIUS, "radius below which a road is a curve, m"),
        ("--bridged", RowOptions().bridged, "longest gap that the line of a row bridges, m"),
        ("--car-length", RowOptions().car_length, "longest gap in which the curb is not right, m"),
    ):  # fmt: skip
        command_line.add_number(parser, name, default, "M", text)
