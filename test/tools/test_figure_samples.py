#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/figures: steps that a change of code may have affected, of which a job is repeated."""

import unittest
from functools import partial

from datmo_tools.figures import results_file, sample
from datmo_tools.figures.step import Job, Step, by_name
from figure_steps import Steps


class Sampled(Steps):
    """A step with three jobs that a change may have affected."""

    def setUp(self):
        super().setUp()
        self.value = {"a": 0.1, "b": 0.2, "c": 0.3}
        self.several = self.several_jobs()
        self.run_all(self.several)
        self.runs.clear()

    def several_jobs(self, **rest):
        def work(name, _):
            self.runs.append(name)
            return (name, self.value[name])

        jobs = [Job(name, partial(work, name)) for name in self.value]
        return Step("several", "values", "x", lambda _: jobs, by_name, **rest)

    def test_the_same_result_of_one_job_keeps_the_step(self):
        self.next_run("89abcdef", affected=[self.several])
        failures, said = self.run_all(self.several)
        self.assertEqual((failures, len(self.runs)), ([], 1))
        self.assertIn(f"several: done at 0123abcd, and {self.runs[0]} is the same now", said)
        kept = self.store.results([self.several])["steps"]["several"]
        self.assertEqual(kept["commit"], "0123abcd")
        self.assertEqual(kept["confirmed"], {"commit": "89abcdef", "job": self.runs[0]})
        self.assertEqual(results_file.last_commit(kept), "89abcdef")
        self.assertIn("several: done at", self.run_all(self.several)[1])
        self.assertEqual(len(self.runs), 1)

    def test_another_result_in_the_last_digit_repeats_the_others_too(self):
        self.next_run("89abcdef", affected=[self.several])
        self.value = {name: value + 1e-16 for name, value in self.value.items()}
        self.run_all(self.several)
        self.assertEqual(sorted(self.runs), ["a", "b", "c"])
        done = self.store.results([self.several])["steps"]["several"]
        self.assertEqual((done["commit"], done["confirmed"]), ("89abcdef", None))

    def test_each_job_is_drawn_at_some_commit(self):
        record = self.store.results([self.several])["steps"]["several"]
        names = {"a", "b", "c"}
        self.assertEqual({sample.drawn(record, f"{i:08x}", names) for i in range(50)}, names)

    def test_a_job_that_fails_is_no_confirmation(self):
        self.next_run("89abcdef", affected=[self.several])
        self.value.clear()
        failures, _ = self.run_all(self.several)
        self.assertEqual(len(failures), 3)
        self.assertIsNone(self.store.results([self.several]))

    def test_without_a_sample_all_jobs_run(self):
        record = self.store.results([self.several])["steps"]["several"]
        cases = {"timed": self.several_jobs(timed=True), "other seeds": self.several_jobs(seeded=True)}
        for name, step in cases.items():
            with self.subTest(name):
                self.store = results_file.StepStore(self.folder / name, "89abcdef", {}, {"several": record})
                self.runs.clear()
                self.run_all(step)
                self.assertEqual(sorted(self.runs), ["a", "b", "c"])
        older = {key: value for key, value in record.items() if key != "jobs"}
        single = {**record, "jobs": {"a": record["jobs"]["a"]}}
        for of, names in ((older, {"a", "b", "c"}), (single, {"a"}), (record, {"a", "b"})):
            self.assertIsNone(sample.drawn(of, "89abcdef", names))

    def test_a_run_that_leaves_it_out_does_not_lose_its_record(self):
        self.next_run("89abcdef", affected=[self.several])
        self.assertIsNone(self.store.results([self.several]))
        self.next_run("89abcdef")
        self.run_all(self.several)
        self.assertEqual(len(self.runs), 1)

    def test_a_step_to_be_repeated_is_not_sampled(self):
        self.next_run("89abcdef", affected=[self.several])
        self.store.forget(self.several)
        self.run_all(self.several)
        self.assertEqual(sorted(self.runs), ["a", "b", "c"])


if __name__ == "__main__":
    unittest.main()
