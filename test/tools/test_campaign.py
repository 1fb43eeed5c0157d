#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The campaign: what is reported of the poses, its bounds, and its page."""

import contextlib
import io
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

from datmo_tools.experiments import campaign_compared, soak
from datmo_tools.experiments.campaign import PROGRAMS, effect, main, page
from datmo_tools.experiments.campaign_page import TRACK_FIGURES
from datmo_tools.experiments.fault_bounds import SILENT, beyond, beyond_silent, read_bounds
from datmo_tools.experiments.kept_ids import gap_effect
from datmo_tools.experiments.line_faults import STEREO_INPUTS, faults

TABLE = Path(__file__).resolve().parents[1] / "campaign/fault_bounds.yaml"
SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"


class Gap(unittest.TestCase):
    def test_added_error_after_the_fault_and_half_a_second_later(self):
        stamps = np.array([7.9, 11.0, 11.4, 11.6, 12.0])
        clean = (np.arange(20.0), np.full(20, 0.1))
        result = gap_effect(stamps, np.array([0.1, 0.9, 0.5, 0.2, 0.3]), clean, (8.0, 11.0), 20.0)
        self.assertEqual((result["poses_meanwhile"], result["distance_m"]), (0, 20.0))
        self.assertAlmostEqual(result["first_m"], 0.8)
        self.assertAlmostEqual(result["settled_m"], 0.2)


class Soak(unittest.TestCase):
    def test_growth_is_the_slope_after_the_initial_filling(self):
        hours = np.arange(0.0, 4.0, 0.05)
        memory = np.where(hours < 0.5, 200.0 * hours, 100.0 + 2.0 * (hours - 0.5))
        drift = soak.drift(hours, memory)
        self.assertAlmostEqual(drift["per_hour"], 2.0, places=6)
        self.assertLess(drift["error"], 1e-6)

    def test_noise_is_recognized_by_the_standard_error(self):
        noise = np.random.default_rng(1).normal(0.0, 1.0, 200)
        drift = soak.drift(np.linspace(0.0, 2.0, 200), 50.0 + noise)
        self.assertLess(abs(drift["per_hour"]), 4.0 * drift["error"])
        self.assertGreater(drift["error"], 0.05)

    def test_the_page_compares_the_time_of_a_scan_early_and_late(self):
        samples = [{"hours": i / 60, "dropped": 0, "tracks": 9, "heap_mib": 100, "resident_mib": 200, "median_ms": 5,
                    "percentile_99_ms": 9} for i in range(1, 61)]  # fmt: skip
        soaked = {"samples": samples, "second_quarter_ms": 5.0, "last_quarter_ms": 5.25, "max_slowing": 1.5, "faults": []}
        drive = {"drive": "a.bag", "options": (), "of": 1, "runs": [{"fault": "none", "error": "ended"}]}
        text = page({"made": "", "beyond": [], "begin_s": 8.0, "drives": [drive], "soak": soaked,
                     **dict.fromkeys(("silent", "mutated", "load", "outages"))})  # fmt: skip
        self.assertIn("took 5.00 ms of processor time\nin the second quarter of the drive and 5.25 ms in the last one "
                      "(medians; more than 1.5 times as much is a fault)", text)  # fmt: skip


class Effect(unittest.TestCase):
    """A drive of 20 s with a fault from 8 s to 11 s; without it the pose error is 0.1 m."""

    def setUp(self):
        self.stamps = np.arange(0.0, 20.0, 0.1)
        self.clean = (self.stamps, np.full(200, 0.1))

    def effect(self, errors):
        return effect(self.stamps, errors, self.clean, 8.0, 11.0)

    def test_an_equally_good_pose_needs_no_recovery(self):
        result = self.effect(np.full(200, 0.3))
        self.assertEqual((result["recovered_s"], result["recovered"]), (0.0, True))
        self.assertAlmostEqual(result["largest_error_m"], 0.3)

    def test_time_to_recovery(self):
        errors = np.full(200, 0.1)
        errors[90:131] = 2.0
        result = self.effect(errors)
        self.assertAlmostEqual(result["recovered_s"], 2.0)
        self.assertTrue(result["recovered"])

    def test_a_pose_that_stays_wrong_is_reported(self):
        result = self.effect(np.where(self.stamps < 9.0, 0.1, 3.0))
        self.assertFalse(result["recovered"])
        run = {"fault": "scan silent", "error": None, "pose": result,
               "tracks": {"mota": 0.5, "misses": 3, "false_positives": 0, "id_switches": 1}}  # fmt: skip
        result.update(largest_sigma_m=0.25, largest_error_sigmas=12.0)
        drive = {"drive": "a.bag", "options": ("--fusion", "low"), "of": 3, "runs": [run]}
        parts = dict.fromkeys(("silent", "mutated", "soak", "load", "outages"))
        text = page({"made": "commit abc", "beyond": ["a.bag, scan silent: too far"], "begin_s": 8.0, "drives": [drive], **parts})
        self.assertIn("| scan silent | 200 | 3.00 | 3.00 | 0.25 | 12.0 | never | 0.500 | 3 | 0 | 1 |", text)
        self.assertIn("run_bag --fusion low", text)
        self.assertNotIn("Soak", text)
        self.assertIn("`scripts/campaign`, commit abc.", text)
        self.assertIn("- a.bag, scan silent: too far", text)
        self.assertIn("[at the end](#beside-autoware-and-px4)", text)
        self.assertIn("\n## Beside Autoware and PX4\n", text)


class Compared(unittest.TestCase):
    """The campaign's figures beside what Autoware and PX4 promise and test."""

    PARTS = ("mutated", "soak", "load", "outages")

    def report(self, **parts):
        runs = [{"fault": fault, "error": error, "pose": {"largest_error_m": 0.5}, "tracks": {"mota": mota}}
                for fault, error, mota in (("none", None, 0.7), ("scan silent for 3 s", None, 0.45), ("scan frozen for 3 s", "ended", None),
                                           ("all clocks back by 100 s (a looped bag)", None, None))]  # fmt: skip
        return {"drives": [{"drive": "a.bag", "runs": runs}], **dict.fromkeys(self.PARTS), **parts}

    def test_what_was_measured(self):
        text = campaign_compared.compared(self.report())
        self.assertIn("Scanner silent for 3 s: 0.50 m, 0.450; frozen: (no result); late by 1 s: (not run); no fault: 0.50 m, 0.700.", text)
        self.assertIn("all clocks back by 100 s: 0.50 m, in the new map", text)

    def test_parts_of_the_campaign(self):
        outages = [{"what": what, "loaded_s": loaded, "tracks_s": loaded + 0.1, "id_kept": kept}
                   for what, loaded, kept in (("nothing", 0.0, True), ("tracker unloaded", 0.5, True), ("risk unloaded", 0.3, False),
                                              ("the process killed", 1.8, None))]  # fmt: skip
        times = {"median_s": 0.1, "percentile_99_s": 0.25}
        samples = [{"hours": i / 60, "dropped": 0, "tracks": 9, "heap_mib": 100 + i / 60, "resident_mib": 200, "median_ms": 5,
                    "percentile_99_ms": 9} for i in range(1, 61)]  # fmt: skip
        text = campaign_compared.compared(self.report(
            outages=outages, load={"nominal": times, "load": times}, soak={"samples": samples},
            mutated={"mutated": 3000, "drives": 45, "faults": ["seed 21"]}))  # fmt: skip
        self.assertIn("| 3000 messages with corrupted fields, in 45 drives; faults found: 1. ", text)
        self.assertIn("Each of 2 nodelets, unloaded, is loaded again within 0.5 s, with tracks within 0.6 s; a track keeps its id in 1 of 2 "
                      "cases; a killed process has tracks again after 1.9 s", text)  # fmt: skip
        self.assertIn("at three times the rates: 0.10 s (0.25 s) instead of 0.10 s (0.25 s)", text)
        self.assertIn("1.0 hours: allocated memory grows by 1.00 +- 0.00 MiB an hour, 0 messages dropped", text)

    def test_every_source_is_cited_and_has_an_address(self):
        text = campaign_compared.compared(self.report())
        cited = set(re.findall(r"\]\[([\w-]+)\]", text))
        self.assertEqual(cited, set(re.findall(r"^\[([\w-]+)\]: https://\S+$", text, re.MULTILINE)))
        self.assertGreater(len(cited), 40)

    def test_faults_are_those_of_the_campaign(self):
        self.assertLessEqual(set(campaign_compared.FAULTS.values()), {fault.name for fault in faults()})


class Chosen(unittest.TestCase):
    def said(self, *options):
        """Returns the output of the command line with an empty bag, which is not valid."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for file in ("drive.bag", "config.yaml", *PROGRAMS):
                (folder / file).touch(mode=0o755)
            said = io.StringIO()
            with contextlib.redirect_stderr(said):
                main([f"{name}/drive.bag", "--config", f"{name}/config.yaml", "--programs", name, "--page", f"{name}/p.md", *options])
            return said.getvalue()

    def test_a_part_that_is_in_no_name(self):
        self.assertIn("--faults 'scan slient': in no fault's name, expected a part of one of none, scan silent for 3 s",
                      self.said("--faults", "odometry silent", "scan slient"))
        self.assertNotIn("in no fault's name", self.said("--faults", "odometry silent"))
        self.assertIn("--faults 'stereo'", self.said("--faults", "stereo"))


class Script(unittest.TestCase):
    def test_sources_without_a_commit_are_refused_at_the_start(self):
        with tempfile.TemporaryDirectory() as name:
            scripts = Path(name, "sources", "scripts")
            scripts.mkdir(parents=True)
            for file in ("campaign", "lib.sh"):
                shutil.copy(SCRIPTS / file, scripts)
            for step in ("setup", "build"):
                (scripts / step).write_text(f"#!/bin/sh\necho {step}\n")
                (scripts / step).chmod(0o755)
            done = subprocess.run([scripts / "campaign"], env={**os.environ, "GIT_CEILING_DIRECTORIES": name}, text=True,
                                  capture_output=True, check=False)  # fmt: skip
        self.assertIn(f"error: {name}/sources: no git commit", done.stderr)
        self.assertEqual((done.returncode, done.stdout), (1, "setup\n"))


class Bounds(unittest.TestCase):
    """A drive with a MOTA of 0.7, and one fault."""

    LIMITS = {"largest_error_m": 1.0, "largest_error_sigmas": 3.0, "recovered_s": 0.5, "mota_loss": 0.1,
              "added_false_positives": 10, "added_id_switches": 1}  # fmt: skip

    def beyond(self, limits, pose=None, error=None, **tracks):
        good = {"largest_error_m": 0.5, "largest_error_sigmas": 2.0, "recovered_s": 0.0, "recovered": True}
        clean = {"fault": "none", "error": None, "pose": good,
                 "tracks": {"mota": 0.7, "misses": 5, "false_positives": 4, "id_switches": 2}}  # fmt: skip
        run = {"fault": "scan silent", "error": error, "refused": error == "all refused", "pose": {**good, **(pose or {})},
               "tracks": {"mota": 0.65, "misses": 9, "false_positives": 14, "id_switches": 3, **tracks}}  # fmt: skip
        bounds = {"a.bag": {"default": self.LIMITS, "scan silent": limits}}
        return beyond({"drive": "a.bag", "runs": [clean, run]}, bounds)

    def test_within(self):
        self.assertEqual(self.beyond({}), [])

    def test_each_bound(self):
        for pose in ({"largest_error_m": 1.1}, {"largest_error_sigmas": 3.5}, {"recovered_s": 0.6},
                     {"recovered": False}):  # fmt: skip
            self.assertEqual(len(self.beyond({}, pose)), 1, pose)
        self.assertEqual(self.beyond({}, mota=0.5), ["a.bag, scan silent: mota_loss 0.200, expected at most 0.1"])
        self.assertEqual(len(self.beyond({}, mota=None)), 1)
        self.assertEqual(self.beyond({}, false_positives=15), ["a.bag, scan silent: added_false_positives 11, expected at most 10"])
        self.assertEqual(self.beyond({}, id_switches=4), ["a.bag, scan silent: added_id_switches 2, expected at most 1"])

    def test_tracks_without_a_score_are_beyond_the_bounds_that_there_are(self):
        none = dict.fromkeys(TRACK_FIGURES)
        self.assertEqual(len(self.beyond({}, **none)), 3)
        self.assertEqual(self.beyond({"mota_loss": None, "added_false_positives": None, "added_id_switches": None}, **none), [])

    def test_a_fault_may_have_bounds_of_its_own_or_none(self):
        self.assertEqual(self.beyond({"largest_error_m": 2.0}, {"largest_error_m": 1.1}), [])
        self.assertEqual(self.beyond({"recovered_s": None}, {"recovered": False}), [])

    def test_invalid_bounds_are_refused(self):
        self.assertEqual(self.beyond("refused", error="all refused"), [])
        self.assertEqual(len(self.beyond("refused")), 1)
        self.assertEqual(self.beyond("refused", error="no pose"), ["a.bag, scan silent: no pose"])
        self.assertEqual(self.beyond({}, error="ended"), ["a.bag, scan silent: ended"])

    def test_nan_is_beyond_every_bound(self):
        self.assertEqual(len(self.beyond({}, {"largest_error_m": float("nan")})), 1)
        self.assertEqual(len(self.beyond({}, mota=float("nan"))), 1)

    def test_a_drive_that_failed_without_a_fault(self):
        drive = {"drive": "a.bag", "runs": [{"fault": "none", "error": "ended"}]}
        self.assertEqual(beyond(drive, {"a.bag": {"default": self.LIMITS}}), ["a.bag, none: ended"])

    def test_a_silent_scanner(self):
        bounds = {SILENT: {"share_of_distance": 0.05, "lost_ids": 1}}
        good = {"level": "low", "from_s": 5.0, "error": None, "settled_m": 0.5, "distance_m": 20.0, "tracked": 2, "kept": 1}
        self.assertEqual(beyond_silent([good, {**good, "level": "object"}], bounds), [])
        self.assertEqual(beyond_silent([good, good], bounds), ["low, scan silent: lost_ids 2, expected at most 1"])
        self.assertEqual(beyond_silent([{**good, "settled_m": 2.0}], bounds), ["low, scan silent: share_of_distance 0.100, expected at most 0.05"])
        self.assertEqual(len(beyond_silent([{**good, "settled_m": None}], bounds)), 1)
        self.assertEqual(beyond_silent([{**good, "error": "ended"}], bounds), ["low, scan silent from 5 s: ended"])

    def test_the_table_of_the_package(self):
        bounds = read_bounds(TABLE)
        known = {fault.name for fault in [*faults(), *faults(STEREO_INPUTS)]} | {"default"}
        for drive, of_drive in bounds.items():
            if drive != SILENT:
                self.assertLessEqual(set(of_drive), known, drive)


if __name__ == "__main__":
    unittest.main()
