# SPDX-License-Identifier: BSD-3-Clause
"""Formats the report of evaluate borders."""

from datmo_tools.evaluate.border_tally import GROUPS
from datmo_tools.evaluate.report import Section
from datmo_tools.text_table import percent, rounded

# Headings, and the cell of one band: by group of stations, and of all of them.
BY_GROUP = (
    ("found, %", lambda item: f"{percent(item['found_share'])} of {item['stations']}"),
    ("error, RMS, m", lambda item: rounded(item["rms_m"], 2)),
)
OF_ALL = (
    ("error, mean, m", lambda item: rounded(item["mean_m"], 2)),
    ("size of it, median, m", lambda item: rounded(item["median_m"], 2)),
    ("90 %, m", lambda item: rounded(item["quantile_90_m"], 2)),
    ("95 %, m", lambda item: rounded(item["quantile_95_m"], 2)),
    ("within 0.5 m, %", lambda item: percent(item["near_share"])),
    ("from the curb, RMS, m", lambda item: rounded(item["curb_rms_m"], 2)),
    ("beyond the gate", lambda item: f"{item['beyond_gate']} of {item['published']}"),
    ("sigma, mean, m", lambda item: rounded(item["mean_sigma_m"], 2)),
    ("NEES, mean", lambda item: rounded(item["mean_nees"], 2)),
    ("NEES, median", lambda item: rounded(item["median_nees"], 2)),
    ("in 95 % gate, %", lambda item: percent(item["in_gate_95"])),
)

EPISODES = 10  # listed


def sections(result):
    """Returns a list of Section for a score of evaluate borders (dict)."""
    bands = [f"{near:g}-{far:g} m" if near >= 0.0 else f"{near:g} to {far:g} m"
             for near, far in result["bands_m"]]  # fmt: skip
    lists = f"{result['lists']} lists of borders ({result['without_truth']} more without truth)"
    parts = [Section(lines=[lists])]
    for heading, cell in BY_GROUP:
        rows = [[heading, *bands]]
        for group in GROUPS:
            if result["borders"][group][-1]["stations"]:
                rows.append([group, *(cell(item) for item in result["borders"][group])])
        parts.append(Section(rows=rows))
    rows = [["all", *bands]]
    rows += [[heading, *map(cell, result["borders"]["all"])] for heading, cell in OF_ALL]
    return [*parts, Section(rows=rows), Section(lines=_false(result["false"]))]


def _false(item):
    sorts = ", ".join(f"{length:.0f} m {where}" for where, length in item["by_where_m"].items())
    lines = [
        f"False: {item['false_m']:.0f} m of {item['published_m']:.0f} m "
        f"({percent(item['false_share'], 2)} %): {sorts}; "
        f"in {item['lists_with_false']} of {item['lists']} lists, {len(item['episodes'])} stretches"
    ]
    longest = sorted(item["episodes"], key=lambda one: -one["lists"] * one["longest_m"])
    lines += [
        f"  {one['side']}, {one['where']}, {one['longest_m']:g} m, from {one['from_s']:.2f} s to "
        f"{one['to_s']:.2f} s, {one['lists']} lists, at map ({one['position_m'][0]:g}, "
        f"{one['position_m'][1]:g})"
        for one in longest[:EPISODES]
    ]
    return lines
