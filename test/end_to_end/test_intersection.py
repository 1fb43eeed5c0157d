#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The simulated intersection through the whole chain, against the requirements: every object that
the scanner sees moving for more than a second is found. Besides the seed of the committed bag
others are used, so that the result does not depend on chance. Without odometry, too, the pose is
accurate.
"""

import tempfile
import unittest
from pathlib import Path

from bounds import check, seeds
from datmo_tools.evaluate.metric_groups import OBJECT_METRICS, metric_groups
from scene_figures import intersection_score, of_intersection, without_odometry

MIN_MOVERS = 6

# The scene has one intersection, and the stack does not report yet where it sees one.
NOT_MEASURED = {"thesis.intersections_found", "thesis.intersections_false"}


class Intersection(unittest.TestCase):
    def test_every_mover_is_found(self):
        for seed in seeds("intersection"):
            with self.subTest(seed=seed), tempfile.TemporaryDirectory() as folder:
                result = intersection_score(Path(folder), seed)
                self.assertGreaterEqual(len(result["objects"]), MIN_MOVERS)
                check(self, "intersection", seed, of_intersection(result))
                self.assert_all_is_measured(result)

    def test_pose_without_odometry(self):
        for seed in seeds("without_odometry"):
            with tempfile.TemporaryDirectory() as folder:
                check(self, "without_odometry", seed, without_odometry(Path(folder), seed))

    def assert_all_is_measured(self, result):
        """What evaluate shows is in what score_run writes, under the same names."""
        for group in metric_groups([result]):
            for metric in group.metrics:
                measured = metric.value(result) is not None
                self.assertNotEqual(measured, metric.path in NOT_MEASURED, metric.path)
        for metric in OBJECT_METRICS:
            self.assertTrue([item for item in result["objects"] if metric.value(item) is not None])


if __name__ == "__main__":
    unittest.main()
