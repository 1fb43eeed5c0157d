#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Warnings in encounters after the public test protocols, from the true objects and from the
stack's own tracks: there is a timely warning of hits, and none of near misses and of vehicles that
are merely followed."""

import os
import tempfile
import unittest
from pathlib import Path

import rosbag

from datmo_tools.evaluate.risk_drives import read_drive
from datmo_tools.evaluate.risk_scores import (is_warned_in_time, lead_of, ttc_errors, warnings_of)
from datmo_tools.experiments.encounters import main
from datmo_tools.programs import call

PROGRAMS = Path(os.environ["RUN_BAG"]).parent
CONFIG = Path(__file__).resolve().parents[2] / "config" / "demonstrator.yaml"
HITS = ("pedestrian_near_40_hit", "pedestrian_far_30_hit", "cyclist_across_40_hit", "car_standing_50_hit",
        "car_slower_40_hit")  # fmt: skip
NEAR_MISSES = ("pedestrian_near_40_space", "pedestrian_far_30_time", "cyclist_across_40_space",
               "cyclist_along_40_space", "car_standing_50_space", "turn_across_45_15_space")  # fmt: skip
# Errors of the time to contact (s) from true tracks, of all frames within 3 s of a contact; median and
# 95 %. Measured are 0.017 and 0.065, for all of six seeds: half more fails.
MEDIAN_TTC, LARGE_TTC = 0.025, 0.097


def drive_of(name, tracks="true"):
    """Returns the risks (RiskDrive) of one scene by the shipped method."""
    with tempfile.TemporaryDirectory() as folder:
        code = main([folder, "--programs", str(PROGRAMS), "--config", str(CONFIG), "--tracks", tracks,
                     "--methods", "futures", "--only", name])  # fmt: skip
        if code != 0:
            raise AssertionError(f"{name}: encounters ended with {code}")
        return read_drive(Path(folder) / tracks / "futures" / f"{name}.bag")


class FromTrueObjects(unittest.TestCase):
    def test_there_is_a_timely_warning_of_hits(self):
        drives = [drive_of(name) for name in HITS]
        for drive in drives:
            self.assertTrue(is_warned_in_time(drive), f"{drive.name}: lead {lead_of(drive)}")
        errors = sorted(abs(error) for error in ttc_errors(drives))
        self.assertGreater(len(errors), 20 * len(HITS))
        self.assertLess(errors[len(errors) // 2], MEDIAN_TTC)
        self.assertLess(errors[int(0.95 * len(errors))], LARGE_TTC)

    def test_there_is_no_warning_of_near_misses(self):
        for name in NEAR_MISSES:
            self.assertEqual(warnings_of(drive_of(name)), [], name)


class FromOwnTracks(unittest.TestCase):
    def test_there_is_a_timely_warning_of_a_stationary_car(self):
        drive = drive_of("car_standing_50_hit", "own")
        self.assertTrue(is_warned_in_time(drive), f"lead {lead_of(drive)}")

    def test_unmapped_objects_are_no_walls(self):
        """The car ahead is there from the first scan on, and the child is a beam of one scan at first."""
        followed = drive_of("car_braking_12_2_50_hit", "own")
        start = followed.frames[0].time
        self.assertFalse([begin for begin, _ in warnings_of(followed) if begin < start + 1.0])
        child = drive_of("child_behind_cars_30_space", "own")
        self.assertEqual(warnings_of(child), [])


class Replayed(unittest.TestCase):
    def test_risks_are_repeatable_and_depend_on_the_method(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            drive, run, again, other = (folder / f"{each}.bag" for each in ("drive", "run", "again", "other"))
            code = main([name, "--programs", str(PROGRAMS), "--scenes-only", "--only", "car_slower_60_hit"])
            self.assertEqual(code, 0)
            config = ("--config", CONFIG)
            call(PROGRAMS / "simulate", folder / "scenes" / "car_slower_60_hit.yaml", drive, "--set",
                 "duration=4", "--quiet")  # fmt: skip
            call(PROGRAMS / "run_bag", drive, run, *config, "--road-border", "--risk", "--with-truth", "--quiet")
            call(PROGRAMS / "replay_risks", run, drive, again, *config)
            call(PROGRAMS / "replay_risks", run, drive, other, *config, "--set", "method=rss")
            self.assertEqual(risks_in(again), risks_in(run))
            self.assertGreater(len(risks_in(again)), 30)
            self.assertNotEqual(risks_in(other), risks_in(run))
            self.assertEqual(topics_of(again), {"/risks"} | {t for t in topics_of(run) if "truth" in t})


def risks_in(path):
    """Returns times and bytes of the risks in a bag."""
    with rosbag.Bag(str(path)) as bag:
        return [(time, message[1]) for _, message, time in bag.read_messages("/risks", raw=True)]


def topics_of(path):
    """Returns the names (set) of a bag's topics."""
    with rosbag.Bag(str(path)) as bag:
        return set(bag.get_type_and_topic_info().topics)


if __name__ == "__main__":
    unittest.main()
