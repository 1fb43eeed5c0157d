#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The stack on three computers (network namespaces) with 20 ms +- 10 ms of delay and 2 % packet
loss: the tracks are those of run_bag, the clock offsets are known, and a killed part recovers.
scripts/machines has the figures."""

import os
import re
import tempfile
import unittest
from pathlib import Path

from datmo_tools.experiments import lossy_network, machines, machines_run
from datmo_tools.experiments.lossy_network import LossyNetwork, Quality

PACKAGE = Path(__file__).resolve().parents[2]
KILL = machines_run.Kill("risk", 5.0)
QUALITY = Quality(0.02, 0.01, 0.02)


class ThreeComputers(unittest.TestCase):
    def setUp(self):
        reason = lossy_network.why_not()
        if reason is not None:
            self.skipTest(reason)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_the_results_are_those_of_one_computer(self):
        drive = machines.fixture_drive(PACKAGE, self.folder)
        with LossyNetwork(machines_run.COMPUTERS, QUALITY) as network:
            three = machines_run.run(drive, network, True, PACKAGE / "launch/perception.launch", self.folder, [KILL])
        reference = machines_run.on_bag(drive, Path(os.environ["RUN_BAG"]).parent, self.folder)
        same = machines.sameness(reference, three)
        self.assertGreater(same["lists"], 300)
        self.assertLess(same["lists_missing"], 0.1 * same["lists"])
        self.assertGreater(same["tracks"], 300)
        self.assertLess(same["unpaired"], 0.1 * same["tracks"])
        self.assertLess(same["median_m"], 0.05)
        self.assertEqual(len(three.kills), 1)
        self.assertIsNotNone(machines_run.recovery(three, three.kills[0]), "risks come again")
        self.check_clocks(machines.clock_offsets(three))

    def check_clocks(self, offsets):
        """All of them run on this machine."""
        self.assertEqual(set(offsets), {"clock of perception_" + part for part in ("sensors", "stereo", "risk")})
        for text in offsets.values():
            ahead, uncertainty = map(float, re.match(r"([\d.]+) \+- ([\d.]+) ms", text).groups())
            self.assertLessEqual(ahead, uncertainty + 0.1, "but for rounding")


if __name__ == "__main__":
    unittest.main()
