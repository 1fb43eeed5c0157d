# SPDX-License-Identifier: BSD-3-Clause
"""The one-to-one matcher of score_run, for distances that Python tools measure themselves."""

import json
import sys
import tempfile
from pathlib import Path

import numpy as np

from datmo_tools import programs
from datmo_tools.errors import InputError


def nearest_pairs(tables):
    """Returns for each table of distances the pairs (row, column) that score_run's matcher chooses:
    as many as possible, one to one, with the least sum of distances; by increasing row.

    tables: list of arrays n x m, 0 or more; infinite: never a pair. Raises InputError if the
    program choose_pairs is missing or fails.
    """
    candidates = [_candidates(np.asarray(table, dtype=float)) for table in tables]
    with tempfile.TemporaryDirectory(prefix="choose_pairs_") as folder:
        file = Path(folder) / "lists.json"
        file.write_text(json.dumps(candidates), encoding="utf-8")
        program = Path(programs.find("choose_pairs", sys.argv[0]))
        try:
            indices = json.loads(programs.output_of(program, file))
        except programs.StepFailed as error:
            raise InputError(str(error)) from error
    return [[tuple(pairs[index][:2]) for index in taken] for pairs, taken in zip(candidates, indices)]


def _candidates(distances):
    """Returns a list of [row, column, gain]."""
    if distances.size == 0:
        return []
    is_near = np.isfinite(distances)
    costs = np.where(is_near, distances, 0.0)
    # Worth more than any sum of distances: one more pair always pays.
    gains = 1.0 + np.sum(costs.max(axis=0)) - costs
    return [[int(i), int(j), float(gains[i, j])] for i, j in zip(*np.nonzero(is_near))]
