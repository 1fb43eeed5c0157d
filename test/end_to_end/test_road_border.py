#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Road borders (thesis 3.5) on simulated streets: their positions on straight roads and in bends,
the intersection, an open place and a border on one side only. Several seeds are used, so that the
result does not depend on chance.
"""

import tempfile
import unittest
from pathlib import Path

import rosbag
from bounds import check, seeds
from datmo_tools.bag_file import whole_bag
from datmo_tools.evaluate.border_lists import BORDERS, read_borders
from scene_figures import SCENES
from scene_runs import computed, simulated


class RoadBorder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def check_scene(self, scene):
        for seed in seeds(scene):
            check(self, scene, seed, SCENES[scene](self.folder, seed))

    def test_bends(self):
        self.check_scene("bend")

    def test_turn_at_an_intersection(self):
        """It is found, and no other is reported."""
        self.check_scene("intersection_borders")

    def test_one_side(self):
        self.check_scene("one_side")

    def test_no_road(self):
        """A car park is no intersection."""
        for seed in seeds("car_park"):
            with self.subTest(seed=seed):
                run = computed(simulated(self.folder, "car_park", seed), "--road-border")
                with rosbag.Bag(str(run)) as bag:
                    states = [item.at_intersection for _, item, _ in bag.read_messages([BORDERS])]
                self.assertGreater(len(states), 400)
                self.assertEqual(sum(states), 0)

    def test_looped_bag(self):
        """Borders start over when the bag loops: the second time they are found as well."""
        recorded = simulated(self.folder, "one_side")
        once = computed(recorded, "--road-border")
        again = computed(self.looped(recorded), "--road-border")
        first = [len(item.borders) for item in read_borders(once)]
        self.assertGreaterEqual(sum(map(bool, first)), 0.8 * len(first))
        with rosbag.Bag(str(again)) as bag:
            lists = [len(item.borders) for _, item, _ in bag.read_messages([BORDERS])]
        self.assertEqual(lists[: len(first)], first)
        second = lists[len(first) :]
        self.assertGreaterEqual(len(second), 0.98 * len(first))
        self.assertGreaterEqual(sum(map(bool, second)), 0.8 * len(first))

    def looped(self, recorded):
        """Returns a bag with all messages twice, one time after the other, with the same stamps."""
        path = self.folder / "looped.bag"
        with rosbag.Bag(str(recorded)) as bag, whole_bag(path, "test") as out:
            length = round(1e9 * (bag.get_end_time() - bag.get_start_time())) + 10**8
            for turn in range(2):
                for topic, message, time in bag.read_messages():
                    write = out.write_latched if topic == "/tf_static" else out.write
                    write(topic, time.to_nsec() + turn * length, message)
        return path


if __name__ == "__main__":
    unittest.main()
