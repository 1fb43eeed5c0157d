#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/figures: the commit of the figures, and which earlier steps a change leaves as they are."""

import contextlib
import io
import subprocess
import unittest
from functools import partial
from unittest import mock

from datmo_tools.errors import InputError
from datmo_tools.figures import main, render, results_file
from datmo_tools.figures.commits import CHANGED, changed_files, commit_of
from datmo_tools.figures.earlier import Earlier, earlier_steps
from datmo_tools.figures.step import Job, Step, by_name
from folder_case import InFolder

# A file that affects the risk and the speed, and one that affects every step.
RISK, TRACKER = "src/risk/criticality.cpp", "src/tracking/tracker.cpp"


class Checkout(InFolder):
    """A git checkout with a commit."""

    def setUp(self):
        super().setUp()
        self.git("init")
        self.write(**{RISK: "1", TRACKER: "1", "README.md": "1"})
        self.commit()

    def git(self, *words):
        identity = ("-c", "user.name=n", "-c", "user.email=e@x")
        subprocess.run(["git", "-C", str(self.folder), *identity, *words], check=True,
                       capture_output=True)  # fmt: skip

    def write(self, **texts):
        for name, text in texts.items():
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).write_text(text)

    def commit(self):
        """Returns the commit of the figures."""
        self.git("add", ".")
        self.git("commit", "-m", "all")
        return commit_of(self.folder)


class Commit(Checkout):
    def test_documents_may_change_and_sources_may_not(self):
        commit = commit_of(self.folder)
        self.assertRegex(commit, "^[0-9a-f]{8}$")
        self.write(**{"README.md": "2", "doc/limits.md": "1"})
        self.assertEqual(commit_of(self.folder), commit)
        self.assertEqual(self.commit(), commit)
        self.write(**{TRACKER: "2"})
        self.assertEqual(commit_of(self.folder), commit + CHANGED)

    def test_names_that_only_begin_alike_are_sources(self):
        commit = commit_of(self.folder)
        self.write(**{"documents.cpp": "1"})
        self.assertNotEqual(self.commit(), commit)

    def test_no_checkout(self):
        with self.assertRaisesRegex(InputError, "expected a git checkout"):
            commit_of(self.folder.parent)


class ChangedFiles(Checkout):
    def test_both_names_of_a_renamed_file(self):
        earlier = commit_of(self.folder)
        self.git("mv", TRACKER, "README.txt")
        self.commit()
        self.assertEqual(changed_files(self.folder, earlier), ["README.txt", TRACKER])

    def test_no_change(self):
        self.assertEqual(changed_files(self.folder, commit_of(self.folder)), [])

    def test_unknown_for_what_is_no_ancestor(self):
        first = commit_of(self.folder)
        self.write(**{TRACKER: "2"})
        second = self.commit()
        self.git("checkout", first)
        for earlier in (second, "0123abcd", first + CHANGED, "--all"):
            self.assertIsNone(changed_files(self.folder, earlier))


class EarlierSteps(Checkout):
    STEPS = tuple(Step(name, "a value", "x", None, by_name) for name in ("slam", "risk", "speed"))

    def setUp(self):
        super().setUp()
        self.file = self.folder / "doc/results.json"
        self.results = {"format": results_file.FORMAT, "commit": commit_of(self.folder),
                        "machine": results_file.machine(),
                        "steps": {step.name: {"figures": {}} for step in self.STEPS}}  # fmt: skip

    def earlier(self, commit):
        """Returns the Earlier steps at a commit."""
        self.write(**{"doc/results.json": results_file.as_text(self.results)})
        return earlier_steps(self.file, self.folder, commit, self.STEPS)

    def kept(self, commit):
        """Returns the names of the earlier steps that count at a commit."""
        return list(self.earlier(commit).unaffected)

    def test_a_change_affects_the_steps_of_its_leaf(self):
        self.write(**{RISK: "2"})
        self.assertEqual(self.kept(self.commit()), ["slam"])

    def test_a_change_of_a_file_in_no_leaf_affects_all(self):
        self.write(**{RISK: "2", TRACKER: "2"})
        self.assertEqual(self.kept(self.commit()), [])

    def test_each_step_is_compared_with_its_own_commit(self):
        self.write(**{TRACKER: "2"})
        self.results["steps"]["risk"]["commit"] = self.commit()
        self.write(**{"benchmark/speed.cpp": "1"})
        self.assertEqual(self.kept(self.commit()), ["risk"])

    def test_a_confirmed_step_is_compared_with_the_commit_at_which_it_was(self):
        self.write(**{TRACKER: "2"})
        self.results["steps"]["risk"]["confirmed"] = {"commit": self.commit(), "job": "a"}
        self.assertEqual(self.kept(commit_of(self.folder)), ["risk"])

    def test_a_change_of_code_may_be_sampled_others_not(self):
        self.write(**{TRACKER: "2"})
        self.assertEqual(list(self.earlier(self.commit()).affected), ["slam", "risk", "speed"])
        self.write(**{"tools/datmo_tools/figures/risk.py": "1"})
        self.assertEqual(list(self.earlier(self.commit()).affected), ["slam", "speed"])
        self.write(**{"tools/datmo_tools/spread.py": "1", "rosbag_fixtures/scenes/yard.yaml": "1"})
        self.assertEqual(self.earlier(self.commit()), Earlier())

    def test_a_change_that_was_taken_back_has_no_effect(self):
        for text in ("2", "1"):
            self.write(**{TRACKER: text})
            commit = self.commit()
        self.assertEqual(self.kept(commit), ["slam", "risk", "speed"])

    def test_changed_sources(self):
        self.assertEqual(self.kept(self.results["commit"] + CHANGED), [])

    def test_no_file_or_an_unreadable_one(self):
        self.assertEqual(earlier_steps(self.file, self.folder, self.results["commit"], self.STEPS), Earlier())
        self.write(**{"doc/results.json": "<<<"})
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(earlier_steps(self.file, self.folder, self.results["commit"], self.STEPS), Earlier())
        self.assertRegex(said.getvalue(), "results.json: cannot be read: .*; no step in it counts as done")


class Again(Checkout):
    """The command line with steps of a line."""

    def run_main(self, *words, broken=False):
        """Returns the exit code, and the names of the steps that have figures then."""
        def work(name, folder):
            self.ran.append(name)
            return (name, {}[name] if broken else 1)

        self.ran = []
        steps = [Step(name, "a value", "x", lambda _, name=name: [Job("a", partial(work, name))], by_name)
                 for name in ("one", "two")]  # fmt: skip
        options = ("--source", str(self.folder), "--out", str(self.folder / "doc/out"), *words)
        said = io.StringIO()
        with mock.patch.object(main, "STEPS", steps), contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            code = main.main(options)
        return code, list(results_file.read(self.folder / render.FILE)["steps"])

    def test_chosen_steps_are_repeated_and_keep_no_old_figures(self):
        self.write(**{"README.md": f"{render.BEGIN}\n{render.END}\n"})
        self.assertEqual(self.run_main(), (0, ["one", "two"]))
        self.assertEqual(self.run_main("--again"), (0, ["one", "two"]))
        self.assertCountEqual(self.ran, ["one", "two"])  # in parallel
        self.assertEqual(self.run_main("--again", "--only", "one", broken=True), (1, ["two"]))
        self.assertEqual(self.ran, ["one"])
        self.assertEqual(self.run_main(), (0, ["one", "two"]))
        self.assertEqual(self.ran, ["one"])


if __name__ == "__main__":
    unittest.main()
