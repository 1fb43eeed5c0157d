# SPDX-License-Identifier: BSD-3-Clause
"""evaluate risk."""

import argparse
from pathlib import Path

from datmo_tools.errors import InputError
from datmo_tools.evaluate.plot_files import drawing_module
from datmo_tools.evaluate.report import Section
from datmo_tools.evaluate.risk_drives import read_drive
from datmo_tools.evaluate.risk_scores import score
from datmo_tools.text_table import percent, rounded

DESCRIPTION = """\
Scores risks against the true contacts of simulated drives, methods side by side. Each folder holds
the bags of one method (run_bag --risk --with-truth, risk/method in the sensor set):

  time to contact   error of the likeliest object's median, within 3 s before a contact
  lead              from the warning that lasts until the contact to it; in time: 1.7 s where the
                    object was in view for 3.5 s, else 80 % of the attainable, which is the time in
                    view and at most 1.7 s
  false             warnings in drives without contact, or ended before it, and how many an hour
  Brier, error      of the probability of contact within 1, 2, 3, 4 s: mean squared difference, and
                    mean distance of predicted and observed frequency in ten bins; on the page also as
                    a reliability diagram"""


_DIAGRAM_HINT = ("Observed frequency of contact over predicted probability. On the dashed line a method is "
                 "calibrated; below it, it predicts too much. The larger a marker, the more frames are in its bin.")


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    parser.add_argument("methods", nargs="+", type=_named_folder, metavar="NAME=FOLDER",
                        help="a method's name, and the folder of its bags")  # fmt: skip


def evaluate(values):
    """Returns the score and its sections. Raises InputError."""
    plot = drawing_module("reliability_plot")
    result = {}
    for name, folder in values.methods:
        bags = sorted(folder.glob("*.bag"))
        if not bags:
            raise InputError(f"{folder}: no bag in it, expected those of run_bag --risk")
        if name in result:
            raise InputError(f"{name}: given twice, expected another name for each folder")
        result[name] = score_of(bags)
    diagram = Section("Reliability", hint=_DIAGRAM_HINT, picture=plot.reliability_drawing(result),
                      for_page=True)  # fmt: skip
    scores, by_horizon, *bins = sections(result)
    return result, [scores, by_horizon, diagram, *bins]


def score_of(bags):
    """Returns the score of one method's bags (list of Path). Raises InputError."""
    return score([read_drive(bag) for bag in bags])


def sections(result, what=""):
    """Returns a list of Section of the scores (dict) by method; `what`: ends the titles."""
    names = list(result)
    rows = [["", *names]]
    for title, cell in _ROWS:
        rows.append([title, *[cell(result[name]) for name in names]])
    horizons = [["within", *[f"{name}: Brier, error" for name in names]]]
    for horizon in result[names[0]]["horizons"]:
        cells = [result[name]["horizons"][horizon] for name in names]
        horizons.append([f"{horizon} s", *[f"{rounded(each['brier'], 3)}, "
                                           f"{rounded(each['calibration_error'], 3)}"
                                           for each in cells]])  # fmt: skip
    return [
        Section(f"Risk{what}", rows=rows),
        Section(f"Probability of contact{what}", rows=horizons),
        *[_reliability(name, result[name]) for name in names],
    ]


def _reliability(name, item):
    rows = [["within", "predicted", "observed", "frames"]]
    for horizon, each in item["horizons"].items():
        rows += [[f"{horizon} s", percent(predicted), percent(observed), str(count)]
                 for predicted, observed, count in each["reliability"]]  # fmt: skip
    return Section(f"Reliability of {name}", rows=rows, for_page=True)


def _of_contacts(item):
    return f"{item['in_time']} of {item['contacts']}"


_ROWS = (
    ("drives", lambda item: str(item["drives"])),
    ("contacts", lambda item: str(item["contacts"])),
    ("time to contact, median error [s]", lambda item: rounded(item["ttc_median_s"], 2)),
    ("time to contact, 95 % error [s]", lambda item: rounded(item["ttc_95_s"], 2)),
    ("contacts warned of", lambda item: str(item["warned"])),
    ("in view for 3.5 s or more, warned in time", lambda item: _of_contacts(item["long_seen"])),
    ("in view for less, warned in time", lambda item: _of_contacts(item["briefly_seen"])),
    ("lead as a share of the attainable, mean", lambda item: rounded(item["lead_share"], 2)),
    ("lead, median [s]", lambda item: rounded(item["lead_median_s"], 2)),
    ("lead, 5 % [s]", lambda item: rounded(item["lead_5_s"], 2)),
    ("near misses", lambda item: str(item["near_misses"])),
    ("near misses warned of", lambda item: str(item["near_misses_warned"])),
    ("false warnings", lambda item: str(item["false_warnings"])),
    ("false warnings an hour", lambda item: rounded(item["false_per_hour"], 1)),
)


def _named_folder(text):
    name, _, folder = text.partition("=")
    if not name or not folder:
        raise argparse.ArgumentTypeError(f"'{text}', expected NAME=FOLDER")
    return name, Path(folder)
