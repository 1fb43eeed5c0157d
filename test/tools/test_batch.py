#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A batch of recordings: its plan, and its runs by Snakemake with stand-in programs."""

import errno
import os
import shutil
import unittest
from pathlib import Path
from unittest import mock

from batch_case import RUN, BatchCase

from datmo_tools.batch.moments import NO_OUTPUT, worst_moments
from datmo_tools.batch.plan import find_recordings
from datmo_tools.errors import InputError


class Batch(BatchCase):
    def test_broken_recording_is_one_line_and_nothing_is_done_twice(self):
        self.record(a="good", b="good", c="good", d="broken")
        code, said, report = self.batch()
        self.assertEqual(code, 1)
        self.assertEqual([one["name"] for one in report["recordings"]], ["a.bag", "b.bag", "c.bag"])
        self.assertEqual([one["name"] for one in report["failed"]], ["d.bag"])
        self.assertIn("is not a bag", report["failed"][0]["error"])
        self.assertEqual(said.count("d.bag: is not a bag") >= 1, True, said)
        self.assertAlmostEqual(report["totals"]["mota"], 1.0 - 6.0 / 30.0)
        self.assertEqual(report["totals"]["dropped"], {"tracker: old": 6})
        self.assertEqual(self.starts(), ["a.bag", "b.bag", "c.bag", "d.bag"])
        page = (self.drives / "batch" / "batch.html").read_text()
        self.assertLess(page.index("Worst moments"), page.index("Recordings</h2>"))
        again = self.batch()[2]
        self.assertEqual(self.starts(), [])
        self.assertEqual(again, report)
        self.record(b="good now")  # another size: it has changed
        self.batch()
        self.assertEqual(self.starts(), ["b.bag"])

    def test_killed_job_is_run_again_and_counts_once(self):
        self.record(a="good", b="kills_once")
        code, said, report = self.batch()
        self.assertEqual(code, 0, said)
        self.assertEqual(self.starts(), ["a.bag", "b.bag", "b.bag"])
        self.assertEqual(report["totals"]["recordings"], 2)

    def test_job_that_is_always_killed_is_not_finished_and_the_others_are(self):
        self.record(a="kills_itself", b="good")
        code, _, report = self.batch()
        self.assertEqual(code, 1)
        self.assertEqual([one["name"] for one in report["recordings"]], ["b.bag"])
        self.assertFalse(report["failed"][0]["finished"])
        self.assertEqual(list((self.drives / "batch" / "recordings").glob("a-*")), [])

    def test_killed_batch_resumes_where_it_was(self):
        self.record(a="good", b="kills_snakemake", c="good")
        first = self.batch()[2]
        done = [one["name"] for one in first["recordings"]]
        self.assertNotIn("b.bag", done)
        code, said, report = self.batch()
        self.assertEqual(code, 0, said)
        self.assertEqual(self.starts(), sorted({"a.bag", "b.bag", "c.bag"} - set(done)))
        self.assertEqual(report["totals"]["recordings"], 3)
        self.assertFalse((self.drives / "batch" / "work").exists())

    def test_full_disk_is_reported_and_not_blamed_on_the_recording(self):
        self.record(a="full", b="full_in_german", c="cannot_write")
        with mock.patch.dict(os.environ, LC_ALL="de_DE.UTF-8", LANGUAGE="de"):
            code, said, report = self.batch()
        self.assertEqual(code, 1)
        self.assertIn("is full", said)
        for failed, reason in zip(report["failed"], (*2 * [os.strerror(errno.ENOSPC)], "cannot be written")):
            self.assertIn(reason, failed["error"])
            self.assertIn("is full", failed["error"])
            self.assertFalse(failed["finished"])
        self.assertEqual(len(report["failed"]), 3)

    def test_options_of_run_bag_reach_it(self):
        self.record(one="")
        code, said, _ = self.batch("--", "--fusion", "track")
        self.assertEqual(code, 0, said)
        self.assertTrue((self.programs / "words").read_text().endswith(" --fusion track\n"))

    def test_another_library_invalidates_results(self):
        self.record(one="")
        library = self.programs.parent / "libdatmo_fusion_core.so"
        library.write_text("1")
        self.batch()
        self.batch()
        self.assertEqual(self.starts(), [])
        library.write_text("2")
        self.batch()
        self.assertEqual(self.starts(), ["one.bag"])

    def test_results_of_former_settings_are_not_those_of_a_batch_that_did_not_start(self):
        self.record(one="")
        self.batch()
        code, _, report = self.batch("--profile", "no such profile", "--", "--mono")
        self.assertNotEqual(code, 0)
        self.assertEqual([one["finished"] for one in report["failed"]], [False])

    def test_moments_of_a_score(self):
        self.record(a="good")
        worst = self.batch()[2]["worst_moments"]
        self.assertEqual(worst[0]["name"], "a.bag")
        self.assertAlmostEqual(worst[0]["at_s"], 0.5)  # the score begins this much later
        self.assertEqual(worst[0]["why"], "0.5 object-seconds missed and 0.5 object-seconds false")
        self.assertAlmostEqual(worst[0]["weight_s"], 1.0)

    def test_recordings_and_what_lies_beside_them(self):
        self.record(a="good", b="good")
        for name in ("a.truth.bag", "b.yaml"):
            (self.drives / name).touch()
        below = self.drives / "below"
        below.mkdir()
        (below / "a.bag").touch()
        out = self.drives / "batch"
        (out / "recordings").mkdir(parents=True)
        (out / "recordings" / "a.bag").touch()
        found = find_recordings(self.drives, out, self.folder / "sensors.yaml")
        self.assertEqual([one.name for one in found], ["a.bag", "b.bag", "below/a.bag"])
        self.assertEqual(len({one.id for one in found}), 3)
        self.assertEqual([one.truth is not None for one in found], [True, False, False])
        self.assertEqual([one.config.name for one in found], ["sensors.yaml", "b.yaml", "sensors.yaml"])
        with self.assertRaisesRegex(InputError, "no sensor set, expected a.yaml next to it"):
            find_recordings(self.drives, out, None)

    def test_nothing_to_do_is_reported(self):
        self.assertIn("no recordings", self.batch()[1])
        shutil.rmtree(self.drives)
        self.assertIn("no such folder", self.batch()[1])


class Moments(unittest.TestCase):
    """The conditions of stages as run_bag reports them."""

    def test_no_output_weighs_twice_as_much_as_degraded(self):
        conditions = [
            {"stage": "tracker", "level": "degraded", "why": "few scans", "from_s": 0.5, "for_s": 1.0},
            {"stage": "grid_slam", "level": "no output", "why": "no odometry", "from_s": 1.0, "for_s": 1.5},
        ]  # fmt: skip
        worst = worst_moments({**RUN, "dropped": [], "conditions": conditions}, None)
        self.assertEqual(worst, [
            {"at_s": 1.0, "for_s": 1.5, "weight_s": 1.5, "why": "grid_slam: no odometry"},
            {"at_s": 0.5, "for_s": 1.0, "weight_s": 0.5, "why": "tracker: few scans"}])  # fmt: skip

    def test_the_word_is_that_of_run_bag(self):
        source = Path(__file__).resolve().parents[2] / "tools/run_bag/run_report.cpp"
        self.assertIn(f'"{NO_OUTPUT}"', source.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
