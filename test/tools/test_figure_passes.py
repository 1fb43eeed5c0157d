#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/figures: a pass of the steps, and which of them count as done."""

import re
import unittest
from pathlib import Path
from unittest import mock

from datmo_tools.errors import InputError
from datmo_tools.figures import results_file
from datmo_tools.figures.commits import CHANGED
from datmo_tools.figures.step import Job, Step, by_name
from datmo_tools.figures.steps import STEPS
from figure_steps import Steps

ROOT = Path(__file__).resolve().parents[2]


class Pass(Steps):
    def test_figures_are_kept_with_how_they_were_made(self):
        step = self.step("one", seeded=True)
        self.assertEqual(self.run_all(step)[0], [])
        done = self.store.results([step])
        self.assertEqual(done["commit"], "0123abcd")
        self.assertEqual(done["steps"]["one"]["commit"], "0123abcd")
        self.assertEqual(done["steps"]["one"]["seeds"], [1, 2])
        self.assertEqual(done["steps"]["one"]["figures"], {"one": {"value": 1.235}})

    def test_finished_steps_do_not_run_again(self):
        step = self.step("one")
        self.run_all(step)
        self.assertIn("one: done at 0123abcd", self.run_all(step)[1])
        self.assertEqual(self.runs, ["one"])

    def test_other_seeds_run_again(self):
        step = self.step("one", seeded=True)
        self.run_all(step)
        self.bench = self.bench._replace(seeds=(1, 2, 3))
        self.assertNotIn("done at", self.run_all(step)[1])

    def test_a_step_that_no_change_has_affected_is_kept_as_it_was_measured(self):
        one, two = self.step("one", seeded=True), self.step("two")
        self.run_all(one)
        self.next_run("89abcdef", one)
        self.assertIn("one: done at 0123abcd", self.run_all(one, two)[1])
        self.assertEqual(self.runs, ["one", "two"])
        done = self.store.results([one, two])
        self.assertEqual(done["commit"], "89abcdef")
        self.assertEqual({name: step["commit"] for name, step in done["steps"].items()},
                         {"one": "0123abcd", "two": "89abcdef"})  # fmt: skip

    def test_an_earlier_step_with_other_seeds_runs_again(self):
        step = self.step("one", seeded=True)
        self.run_all(step)
        self.next_run("89abcdef", step)
        self.bench = self.bench._replace(seeds=(1,))
        self.run_all(step)
        self.assertEqual(self.store.results([step])["steps"]["one"]["commit"], "89abcdef")

    def test_a_step_resumes_with_the_failed_job(self):
        broken = [True]

        def second(_):
            if broken:
                raise InputError("no disk")
            return ("b", 2)

        def first(_):
            self.runs.append("a")
            return ("a", 1)

        step = Step("two", "values", "x", lambda _: [Job("a", first), Job("b", second)], by_name)
        self.assertEqual(self.run_all(step)[0], ["two, b: no disk"])
        broken.clear()
        self.assertEqual(self.run_all(step)[0], [])
        self.assertEqual(self.runs, ["a"])
        self.assertEqual(self.store.results([step])["steps"]["two"]["figures"], {"a": 1, "b": 2})

    def test_with_changed_sources_nothing_counts_as_done(self):
        for _ in range(2):
            self.store = results_file.StepStore(self.folder, "0123abcd" + CHANGED)
            self.run_all(self.step("one"))
        self.assertEqual(self.runs, ["one", "one"])

    def test_results_of_changed_sources_are_those_of_this_run_alone(self):
        one, two = self.step("one"), self.step("two")
        for step in (one, two):  # the sources may have changed again in between
            self.store = results_file.StepStore(self.folder, "0123abcd" + CHANGED)
            self.assertIsNone(self.store.results([one, two]))
            self.run_all(step)
        self.assertEqual(list(self.store.results([one, two])["steps"]), ["two"])

    def test_a_step_without_its_data_is_left_out_and_named(self):
        failures, said = self.run_all(self.step("one", needs=("drive",)))
        self.assertEqual((failures, self.runs), ([], []))
        self.assertRegex(said, "one: left out, .*data/drive is not there")

    def test_a_failed_step_is_reported_and_the_others_continue(self):
        def fail(_):
            raise InputError("no bag")

        bad, broken = self.step("bad", fail), self.step("broken", lambda _: {}["mota"])
        failures, _ = self.run_all(bad, broken, self.step("good", timed=True))
        self.assertEqual(sorted(failures), ["bad, a: no bag", "broken, a: KeyError('mota')"])
        self.assertEqual(list(self.store.results([bad, broken, self.step("good", timed=True)])["steps"]), ["good"])

    def test_scratch_files_are_gone_afterward(self):
        self.run_all(self.step("one", lambda folder: (folder / "big.bag").write_text("") and {}))
        self.assertEqual(list(self.store.folder.rglob("*.bag")), [])


class Timed(Steps):
    """A step that measures time."""

    def setUp(self):
        super().setUp()
        self.timed = self.step("timed", timed=True)

    def change_machine(self):
        another = {"processor": f"not {results_file.machine()['processor']}", "cores": 2}
        patched = mock.patch.object(results_file, "machine", lambda: another)
        patched.start()
        self.addCleanup(patched.stop)

    def test_it_runs_when_the_others_are_done(self):
        self.run_all(self.timed, self.step("one"), self.step("two"))
        self.assertEqual(self.runs[2], "timed")

    def test_times_of_another_machine_do_not_count(self):
        one = self.step("one")
        for commit, again in (("0123abcd", []), ("89abcdef", [self.timed, one])):  # in the store, in the file of figures
            with self.subTest(commit):
                self.run_all(self.timed, one)
                self.next_run(commit, *again)
                self.change_machine()
                self.assertEqual(list(self.store.results([self.timed, one])["steps"]), ["one"])
                self.runs.clear()
                self.run_all(self.timed, one)
                self.assertEqual(self.runs, ["timed"])
                done = self.store.results([self.timed])
                self.assertEqual(done["steps"]["timed"]["machine"], done["machine"])

    def test_the_documents_name_the_steps_that_measure_time(self):
        text = " ".join((ROOT / "doc/evaluation.md").read_text(encoding="utf-8").split())
        named = re.search(r"Steps that measure time \((.*?)\)", text)[1]
        self.assertEqual(set(re.findall(r"`(\w+)`", named)), {step.name for step in STEPS if step.timed})


class Forgotten(Steps):
    """Steps that are to be repeated."""

    def forget(self, *steps):
        for step in steps:
            self.store.forget(step)

    def test_they_run_again(self):
        step = self.step("one")
        self.run_all(step)
        for commit in ("0123abcd", "89abcdef"):  # in the store, in the file of figures
            self.next_run(commit, step)
            self.forget(step)
            self.run_all(step)
        self.assertEqual(self.runs, ["one", "one", "one"])

    def test_one_that_fails_or_lacks_its_data_has_no_figures(self):
        one, two = self.step("one"), self.step("two")
        for commit in ("0123abcd", "89abcdef"):
            self.run_all(one, two)
            self.next_run(commit, one, two)
            self.forget(one, two)
            self.run_all(self.step("one", lambda _: {}["mota"]), self.step("two", needs=("drive",)))
            self.assertIsNone(self.store.results([one, two]))

    def test_an_interrupted_repetition_resumes(self):
        one, two = self.step("one"), self.step("two")
        self.run_all(one, two)
        self.next_run("89abcdef", one, two)
        earlier = self.store.results([one, two])["steps"]
        self.forget(one, two)
        self.run_all(one)
        self.store = results_file.StepStore(self.folder / "out", "89abcdef", earlier)
        self.run_all(one, two)
        self.assertEqual(self.runs[2:], ["one", "two"])


if __name__ == "__main__":
    unittest.main()
