# SPDX-License-Identifier: BSD-3-Clause
"""Formats the figures of a benchmark as a table, alone or next to those of another one."""

import json
import statistics

from datmo_tools.errors import InputError
from datmo_tools.text_table import aligned, rounded

FORMAT = 1  # of the JSON file
MEASURED = ("micro", "live")  # sections of figures; the others describe their origin
NUMBER = "{:.4g}"
LIMIT = "limit/"  # prefix of a hot path's name: only the work that it cannot do without
SPREAD = 1.25  # of a ratio to the limit between measurements, on a shared machine


def read(file):
    """Returns the report of a file (Path). Raises InputError if it is not one."""
    try:
        report = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{file}: cannot be read as a benchmark's JSON: {error}") from error
    if not isinstance(report, dict) or report.get("format") != FORMAT:
        raise InputError(f"{file}: no benchmark of format {FORMAT}")
    return report


def medians(runs):
    """Merges equal nested dicts: the median over the runs for each figure."""
    if isinstance(runs[0], dict):
        return {key: medians([run[key] for run in runs]) for key in runs[0]}
    return statistics.median(runs)


def figures(report):
    """Returns name with slashes -> number, of everything that was measured."""
    flat = {}
    for section in MEASURED:
        _flatten(report.get(section, {}), (section,), flat)
    return flat


def _flatten(value, path, flat):
    if isinstance(value, dict):
        for key, inner in value.items():
            _flatten(inner, (*path, key), flat)
    else:
        flat["/".join(path)] = value


def ratios(report):
    """Returns name -> (us, us of its limit, their ratio), of hot paths with a measured limit."""
    micro = report.get("micro", {})
    found = {}
    for name, run in micro.items():
        limit = micro.get(LIMIT + name)
        if limit and limit["cpu_us"] > 0.0:
            found[name] = (run["cpu_us"], limit["cpu_us"], run["cpu_us"] / limit["cpu_us"])
    return found


def table(report):
    """Returns a line for each figure; first those with a limit, with it."""
    rows = [("", "ours, us", "limit, us", "ratio")]
    rows += [(name, *map(NUMBER.format, values)) for name, values in ratios(report).items()]
    limits = [aligned(rows), ""] if len(rows) > 1 else []
    all_figures = [(name, NUMBER.format(value)) for name, value in figures(report).items()]
    return "\n".join([*limits, aligned(all_figures)])


def slower(old, new):
    """Returns the hot paths whose ratio to their limit has risen by more than its spread."""
    before, after = ratios(old), ratios(new)
    return [
        name for name in before if name in after and after[name][-1] > SPREAD * before[name][-1]
    ]


def judgement(old, new):
    """Returns a line for each hot path with a limit in both, and the change of its ratio."""
    before, after = ratios(old), ratios(new)
    rows = [["times the limit", "old", "new", "new/old", ""]]
    for name in before:
        if name in after:
            change = after[name][-1] / before[name][-1]
            verdict = "slower" if change > SPREAD else "faster" if change < 1.0 / SPREAD else ""
            values = (before[name][-1], after[name][-1])
            rows.append([name, *map(NUMBER.format, values), rounded(change, 2), verdict])
    return aligned(rows) if len(rows) > 1 else "no hot path has a limit in both"


def comparison(old, new):
    """Returns a line for each figure that both have, with new/old; then those that only one has.

    Less than 1 is faster or smaller. Raises InputError if they have nothing in common.
    """
    before, after = figures(old), figures(new)
    common = [name for name in before if name in after]
    if not common:
        raise InputError("the two benchmarks have no figure in common")
    rows = [["", "old", "new", "new/old"]]
    for name in common:
        old_value, new_value = before[name], after[name]
        ratio = new_value / old_value if old_value else None
        rows.append([name, NUMBER.format(old_value), NUMBER.format(new_value), rounded(ratio, 2)])
    lines = [aligned(rows)]
    lines += [f"only in the old one: {name}" for name in before if name not in after]
    lines += [f"only in the new one: {name}" for name in after if name not in before]
    return "\n".join([*_differences(old, new), *lines])


def _differences(old, new):
    """Returns what makes the figures hard to compare, besides the code."""
    return [
        f"{name}: {old['context'].get(name)} -> {new['context'].get(name)}"
        for name in ("commit", "machine", "compiler", "build_type")
        if old["context"].get(name) != new["context"].get(name)
    ]
