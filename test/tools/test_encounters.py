#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Encounters after public test protocols: each is what its name says, by the simulator's own
contact and ground truth."""

import os
import tempfile
import unittest
from pathlib import Path

import rosbag
import yaml

from datmo_tools import programs
from datmo_tools.experiments.encounter_scenes import (AFTER, AVOIDED, CLEAR_TIME, CLEARANCE, ENDINGS, HOST_Y,
                                                        MEETING, STOPS, Encounter, encounters, scene)
from datmo_tools.experiments.encounters import main
from datmo_tools.experiments.random_encounters import random_scenes
from encounter_clearance import EPOCH, bodies, encroachment_time, smallest_distance

PROGRAM = os.environ.get("DATMO_FUSION_TRUE_RISKS", "")
# One of each kind; few beams and a small ground truth: only contact and clearance count.
KINDS = ("pedestrian_far", "child_behind_cars", "cyclist_across", "cyclist_along", "car_standing",
         "car_braking_12_2", "turn_across_45")  # fmt: skip
# Those in which one body is where the other one was; the others end behind one that stands.
WITH_TIME = ("pedestrian_far", "child_behind_cars", "cyclist_across", "cyclist_along", "turn_across_45")
# m and s above the clearance: a cyclist's path is that of the rear axle, so that the body is ahead of the
# scene's arithmetic; a turning host's corner takes longer to leave the lane than the scene assumes.
BEYOND_SPACE = {"cyclist_across": 0.4}
BEYOND_TIME = {"cyclist_across": 0.15, "turn_across_45": 0.3}
COARSE = ("--set", "scanner/beam_spacing=5", "--set", "ground_truth/radius=40", "--risk", "method=rss")


class Scenes(unittest.TestCase):
    def test_names_are_unique_and_each_has_a_hit_and_near_misses(self):
        names = [each.name for each in encounters()]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreater(len(names), 100)
        for ending in ENDINGS:
            self.assertEqual(sum(name.endswith(ending) for name in names), len(names) / 3)

    def test_only_who_crosses_can_stop(self):
        self.assertFalse([each for each in encounters([STOPS]) if each.protocol.startswith("car")])

    def test_random_scenes_are_those_of_their_seed(self):
        first, again = (list(random_scenes(6, 3)) for _ in range(2))
        self.assertEqual(first, again)
        self.assertNotEqual(first, list(random_scenes(6, 4)))
        for each in first:
            times = [point[0] for point in each["actors"][0]["speed"]]
            self.assertEqual(times, sorted(set(times)))

    def test_random_hosts_catch_up_with_who_is_ahead(self):
        for each in random_scenes(400, 5):
            times = [time for time, _ in each["ego"]["speed"]]
            self.assertEqual(times, sorted(set(times)), each)
            actor = each["actors"][0]
            if actor["path"][0][1] == HOST_Y:
                self.assertGreater(actor["path"][0][0], each["ego"]["path"][0][0], each)

    def test_names_of_no_scene_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(main([folder, "--programs", folder, "--only", "nobody"]), 1)

    def test_a_random_scene_that_fails_leaves_no_bags_behind(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for program, script in (("simulate", 'touch "$2"'), ("run_bag", 'touch "$2"; exit 1'),
                                    ("replay_risks", "exit 1")):  # fmt: skip
                (folder / program).write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
                (folder / program).chmod(0o755)
            main([str(folder / "out"), "--programs", name, "--tracks", "own", "--random", "1",
                  "--config", str(folder / "any.yaml")])  # fmt: skip
            self.assertFalse(list((folder / "out").rglob("*.bag")))
            self.assertTrue((folder / "out" / "own").is_dir())


@unittest.skipUnless(PROGRAM, "DATMO_FUSION_TRUE_RISKS is not set")
class Contacts(unittest.TestCase):
    def drive(self, encounter):
        """Returns the time of contact, s after the start, and None, or None and the true bodies."""
        made = scene(encounter)
        if encounter.protocol.startswith("turn"):
            made["options"]["duration"] += AFTER  # until who comes later has come
        with tempfile.TemporaryDirectory() as name:
            file, bag = Path(name) / "scene.yaml", Path(name) / "risks.bag"
            file.write_text(yaml.safe_dump(made), encoding="utf-8")
            programs.call(Path(PROGRAM), file, bag, *COARSE)
            with rosbag.Bag(str(bag)) as opened:
                self.assertTrue(opened.get_message_count("/risks"))
                contact = next((message.header.stamp.to_sec() - EPOCH for _, message, _ in
                                opened.read_messages("/ground_truth/contact")), None)
            return contact, None if contact else bodies(made, bag)

    def test_hits_hit_and_near_misses_miss_by_the_clearances_of_their_names(self):
        for protocol in KINDS:
            host = 15.0 if protocol.startswith("turn") else 50.0
            for ending in ENDINGS:
                with self.subTest(protocol=protocol, ending=ending):
                    contact, both = self.drive(Encounter(protocol, host, ending))
                    self.assertEqual(contact is not None, ending == "hit")
                    if contact and not protocol.startswith("car_braking"):
                        self.assertAlmostEqual(contact, MEETING, delta=0.25)
                    if ending == "space":
                        self.expect(smallest_distance(*both), CLEARANCE, 0.1, BEYOND_SPACE.get(protocol, 0.1))
                    elif ending == "time" and protocol in WITH_TIME:
                        self.expect(encroachment_time(*both), CLEAR_TIME, 0.05, BEYOND_TIME.get(protocol, 0.05))
                    elif ending == "time":
                        self.assertGreater(smallest_distance(*both), CLEARANCE)

    def expect(self, found, wanted, less, more):
        """Expects a clearance, at most `less` below and `more` above the wanted one."""
        self.assertGreater(found, wanted - less)
        self.assertLess(found, wanted + more)

    def test_stopping_and_braking_avoid_it(self):
        self.assertIsNone(self.drive(Encounter("pedestrian_near", 40.0, STOPS))[0])
        self.assertIsNone(self.drive(Encounter("car_slower", 50.0, AVOIDED))[0])


if __name__ == "__main__":
    unittest.main()
