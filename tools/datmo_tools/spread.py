# SPDX-License-Identifier: BSD-3-Clause
"""Summarizes repeated measurements: median and range, or sums."""

import math
import statistics

DIGITS = 4  # significant digits of a figure


def spread(values):
    """Returns [median, min, max] of numbers; None if there are none, or one of them is None."""
    values = list(values)
    if not values or None in values:
        return None
    return [statistics.median(values), min(values), max(values)]


def spread_of(trees):
    """Merges nested dictionaries of equal keys into one, with the spread() of each figure."""
    first = trees[0]
    if isinstance(first, dict):
        return {key: spread_of([tree[key] for tree in trees]) for key in first}
    return spread(trees)


def pooled_counts(runs, counts):
    """Returns the sums of these counts over several runs (dictionaries), and the MOTA as if they
    were one run; required, misses, false_positives and id_switches must be among the counts."""
    total = {key: sum(run[key] for run in runs) for key in counts}
    errors = total["misses"] + total["false_positives"] + total["id_switches"]
    return {**total, "mota": 1.0 - errors / total["required"]}


def rounded(tree):
    """Returns the same value with its numbers rounded to DIGITS significant digits."""
    if isinstance(tree, dict):
        return {key: rounded(value) for key, value in tree.items()}
    if isinstance(tree, (list, tuple)):
        return [rounded(value) for value in tree]
    if isinstance(tree, float):
        return _rounded(tree)
    return tree


def _rounded(value):
    if not math.isfinite(value):
        return None
    return float(f"{value:.{DIGITS}g}")
