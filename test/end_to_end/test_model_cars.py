#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""1:10 cars with motion capture through mocap_to_bag, run_bag and evaluate: the pose and the track
of the other car against what motion capture saw, for the example bags of the package datmo."""

import tempfile
import unittest
from pathlib import Path

from bounds import check
from recorded_figures import CARS, model_car


@unittest.skipUnless(CARS.is_dir(), f"needs the example bags of datmo, which are not in {CARS}")
class ModelCars(unittest.TestCase):
    def test_other_car_is_tracked(self):
        recordings = sorted(CARS.glob("*.bag"))
        self.assertTrue(recordings)
        for recording in recordings:
            with tempfile.TemporaryDirectory() as folder:
                name = recording.stem
                check(self, name, 1, model_car(name, Path(folder), 1))


if __name__ == "__main__":
    unittest.main()
