# SPDX-License-Identifier: BSD-3-Clause
"""Steps of scripts/figures for its tests."""

import contextlib
import io
from pathlib import Path

from datmo_tools.figures import results_file
from datmo_tools.figures.pass_of_steps import run_steps
from datmo_tools.figures.step import Bench, Job, Step, by_name
from folder_case import InFolder

ROOT = Path(__file__).resolve().parents[2]


class Steps(InFolder):
    """Steps of a few lines."""

    def setUp(self):
        super().setUp()
        self.runs = []
        self.bench = Bench(ROOT, self.folder, self.folder, self.folder / "data", (1, 2))
        self.store = results_file.StepStore(self.folder / "out", "0123abcd")

    def step(self, name, work=None, **rest):
        def counted(folder):
            self.runs.append(name)
            return (name, work(folder) if work else {"value": 1.23456})

        return Step(name, "a value", "x", lambda _: [Job("a", counted)], by_name, **rest)

    def run_all(self, *chosen):
        """Returns (failures, output)."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(io.StringIO()):
            failures = run_steps(chosen, self.bench, self.store, 2)
        return failures, said.getvalue()

    def next_run(self, commit, *steps, affected=()):
        """Opens the store anew, with these steps as it has them now in the file of figures; affected:
        those that a change may have affected."""
        found = (self.store.results([*steps, *affected]) or {"steps": {}})["steps"]
        records = [{step.name: found[step.name] for step in group} for group in (steps, affected)]
        self.store = results_file.StepStore(self.folder / "out", commit, *records)
