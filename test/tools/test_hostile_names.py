#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""No name from a bag, or of one, reaches a shell, a page or a yaml file as anything but a name."""

import contextlib
import io
import json
import os
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import simulated_recording as simulated
import yaml
from batch_case import BatchCase
from check_bag_case import Tool, each, of_topic
from evaluation_sample import sample_run
from hostile_names import NAMES, Page

from datmo_tools.check_bag.main import main as check_bag
from datmo_tools.evaluate.main import main as evaluate

DURATION = 1.0  # s, of a recording: the car stands, so that no motion is compared, which takes long

# Stands in for score_run: the run's file holds its score.
SCORE_RUN = '#!/bin/sh\ncp -- "$1" "$3"\n'


class InWorkingFolder(unittest.TestCase):
    """Holds that nothing is created in the working folder."""

    def setUp(self):
        super().setUp()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.working = Path(folder.name)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.working)

    def assert_nothing_was_run(self):
        self.assertEqual(list(self.working.iterdir()), [])


def recording():
    """Returns the beginning of the simulated recording."""
    return [item for item in simulated.recording() if item.recorded < DURATION]


def renamed(name):
    """Returns a recording whose scanner's topic, and whose frames, have this name."""

    def rename(message):
        message.header.frame_id, message.child_frame_id = f"odom {name}", f"base {name}"

    def rename_scanner(message):
        message.header.frame_id = name

    items = each(each(recording(), "/odometry", rename), "/scan", rename_scanner)
    return [item._replace(topic=f"/{name}/scan") if item.topic == "/scan" else item for item in items]


class CheckBag(InWorkingFolder, Tool):
    def check(self, items, bag):
        """Returns what check_bag prints on a recording in the file `bag`."""
        simulated.write(bag, items)
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            check_bag([str(bag), "--out", str(self.yaml), "--force"])
        self.assert_nothing_was_run()
        return out.getvalue()

    def commands(self, said):
        """Returns the words of the printed commands, as a shell would split them."""
        lines = said.partition("\nTo start:\n")[2]
        self.assertTrue(lines, said)
        words = shlex.split(lines)
        starts = [index for index, word in enumerate(words) if word in ("rosrun", "roslaunch")]
        self.assertEqual(len(starts), 2, said)
        return words[: starts[1]], words[starts[1] :]

    def test_words_of_the_commands_and_keys_of_the_yaml(self):
        for name in NAMES:
            with self.subTest(name=name):
                bag = self.folder / f"{name.replace('/', '')}.bag"
                offline, live = self.commands(self.check(renamed(name), bag))
                self.assertEqual(offline[3], str(bag))
                self.assertIn(f"bag:={bag}", live)
                for command in offline, live:
                    self.assertEqual(command.count(f"scan:=/{name}/scan"), 1, command)
                    others = [word for word in command if name.replace("/", "") not in word.replace("/", "")]
                    self.assertNotIn("pwned", "".join(others))
                content = yaml.safe_load(self.yaml.read_text())
                self.assertEqual(content["frames"], {"odom": f"odom {name}", "base": f"base {name}"})
                self.assertEqual(list(content["mounts"])[0], name)
                self.assertNotIn("lines", content)

    def test_each_finding_stays_one_line(self):
        items = [item._replace(topic="/x\n\x1b[2Jno findings\r/scan") if item.topic == "/scan" else item
                 for item in simulated.recording()]  # fmt: skip
        del items[items.index(of_topic(items, "/x\n\x1b[2Jno findings\r/scan")[40])]
        said = self.check(items, self.bag).partition("\nTo start:\n")[0]
        self.assertIn("no findings", said)
        self.assertNotIn("\x1b", said)
        self.assertNotIn("\r", said)
        self.assertFalse([line for line in said.splitlines() if line.startswith("no findings")])

    def test_a_file_name_that_is_not_utf_8(self):
        bag = Path(os.fsdecode(os.fsencode(self.folder) + b"/stra\xdfe.bag"))
        offline, _ = self.commands(self.check(recording(), bag))
        self.assertEqual(offline[3], str(bag))
        yaml.safe_load(self.yaml.read_text())
        environment = {**os.environ, "PYTHONIOENCODING": "utf-8:strict"}  # as in most languages' locales
        words = [sys.executable, "-m", "datmo_tools", "check_bag.main", bag, "--out", self.yaml, "--force"]
        done = subprocess.run(words, env=environment, capture_output=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertIn(f" run_bag '{self.folder}/stra".encode() + b"\xdfe.bag'", done.stdout)


class Evaluate(InWorkingFolder):
    """The page of tracks of runs in which every name that a run holds is hostile."""

    def page(self, names):
        """Returns the Page of runs with these names."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            program = folder / "score_run"
            program.write_text(SCORE_RUN)
            program.chmod(0o755)
            files = [folder / f"{name.replace('/', '')}.bag" for name in names]
            drive = " and ".join(names)  # the same for all runs of a page
            for name, file in zip(names, files):
                run = sample_run(str(file), label=drive, truth=drive, options={name: name})
                run["timing"] = {name: run["timing"]["tracker"]}
                file.write_text(json.dumps(run))
            out = io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
                words = ["tracks", "--compare", *map(str, files), "--out", str(folder / "out")]
                code = evaluate(words, str(program))
            self.assertEqual(code, 0, out.getvalue())
            return Page((folder / "out" / "tracks.html").read_text(encoding="utf-8"))

    def test_names_are_text(self):
        harmless = self.page(["one", "other"])
        self.assertEqual(harmless.active, [])
        page = self.page(NAMES)
        self.assertEqual(page.active, [])
        self.assertEqual(page.tags, harmless.tags)
        for name in NAMES:
            with self.subTest(name=name):
                self.assertGreater(page.text.count(name), 2)
        self.assert_nothing_was_run()


class Batch(InWorkingFolder, BatchCase):
    """Recordings with hostile names in a folder with one, by Snakemake: two are good, the others are
    refused with their name in the message."""

    def test_names_are_text_and_nothing_is_run(self):
        self.drives = self.folder / "; touch pwned; $(touch pwned) '\" <b>{x}"
        self.drives.mkdir()
        names = [f"{name}.bag" for name in NAMES]
        for name in names:
            bag = self.drives / name  # with a slash it is in a folder
            bag.parent.mkdir(exist_ok=True, parents=True)
            bag.write_text("good" if name in names[:2] else "broken")
        code, said, report = self.batch("--", "--tum", "; touch pwned")
        self.assertEqual(code, 1, said)
        self.assertEqual({one["name"] for one in report["recordings"]}, set(names[:2]), said)
        self.assertEqual({one["name"] for one in report["failed"]}, set(names[2:]))
        self.assertTrue(all(one["finished"] for one in report["failed"]), report["failed"])
        self.assertNotIn("\nlines: true", said)
        page = Page((self.drives / "batch" / "batch.html").read_text(encoding="utf-8"))
        self.assertEqual(page.active, [])
        self.assertLessEqual(page.tags & {"b", "img", "x"}, {"b"})  # of the tiles
        for name in names:
            self.assertIn(name, page.text)
        self.assert_nothing_was_run()
        self.assertFalse([path for path in self.folder.rglob("*") if path.name == "pwned"])


if __name__ == "__main__":
    unittest.main()
