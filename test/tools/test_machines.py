#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The experiment with several machines, without any: packets that are delayed and lost, and the
counts."""

import os
import select
import socket
import struct
import time
import unittest

import numpy as np

from datmo_tools.experiments import lossy_network, machines
from datmo_tools.experiments.lossy_network import Quality
from datmo_tools.experiments.machines_run import Result, by_time, latencies, recovery

ENOUGH = 30.0  # s, for what is done immediately


def packet(to, payload=b"payload"):
    """Returns an IPv4 packet, with as much content as the relay reads."""
    return struct.pack("!16s4s", b"\x45", socket.inet_aton(to)) + payload


class Relay(unittest.TestCase):
    def setUp(self):
        self.ends = {}
        self.devices = {}
        for address in ("10.77.0.1", "10.77.0.2"):
            ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_DGRAM)
            theirs.setblocking(False)
            self.addCleanup(ours.close)
            self.addCleanup(theirs.close)
            self.ends[address] = ours
            self.devices[socket.inet_aton(address)] = theirs.fileno()

    def relay(self, quality):
        child = os.fork()
        if child == 0:
            lossy_network._relay(self.devices, quality, os.getppid())
            os._exit(0)
        self.addCleanup(os.waitpid, child, 0)
        self.addCleanup(os.kill, child, 9)

    def comes(self, address, seconds):
        return bool(select.select([self.ends[address]], [], [], seconds)[0])

    def test_a_packet_arrives_at_its_destination_after_its_delay(self):
        self.relay(Quality(delay=0.2, jitter=0.05))
        sent = time.monotonic()
        self.ends["10.77.0.1"].send(packet("10.77.0.2"))
        self.assertTrue(self.comes("10.77.0.2", ENOUGH))
        self.assertGreaterEqual(time.monotonic() - sent, 0.15)
        self.assertEqual(self.ends["10.77.0.2"].recv(100), packet("10.77.0.2"))
        self.assertFalse(self.comes("10.77.0.1", 0.0))

    def test_some_packets_are_lost(self):
        self.relay(Quality(loss=0.5, seed=3))
        for i in range(100):
            self.ends["10.77.0.1"].send(packet("10.77.0.2", bytes([i])))
        self.ends["10.77.0.1"].send(packet("10.77.0.9"))  # no machine has this address
        arrived = []
        while self.comes("10.77.0.2", ENOUGH if len(arrived) < 30 else 1.0):
            arrived.append(self.ends["10.77.0.2"].recv(100)[-1])
        self.assertGreater(len(arrived), 30)
        self.assertLess(len(arrived), 70)


class Figures(unittest.TestCase):
    def test_tracks_within_the_gate_are_paired_each_once(self):
        lists = [([(1, 0.0, 0.0), (2, 10.0, 0.0)], [(7, 0.0, 0.1), (8, 0.0, 0.2), (9, 30.0, 0.0)]),
                 ([], []), ([(3, 5.0, 0.0)], []), ([(4, 5.0, 0.0)], [(5, 5.0, 0.3)])]  # fmt: skip
        distances, alone = machines.paired(lists)
        np.testing.assert_allclose(distances, [0.1, 0.3])
        self.assertEqual(alone, 4)

    def test_tracks_are_paired_by_score_runs_matcher(self):
        """If each took its nearest one in turn, the second track would be left without any."""
        one = [(1, 0.0, 0.0), (2, -0.6, 0.0)]
        other = [(7, 1.9, 0.0), (8, -0.225, np.sqrt(0.16 - 0.225**2))]
        apart = [[np.hypot(a[1] - b[1], a[2] - b[2]) for b in other] for a in one]
        np.testing.assert_allclose(apart, [[1.9, 0.4], [2.5, 0.5]])
        distances, alone = machines.paired([(one, other)], gate=2.0)
        np.testing.assert_allclose(distances, [1.9, 0.5])
        self.assertEqual(alone, 0)

    def test_runs_are_compared_by_the_time_of_the_drive(self):
        one = Result(100.0, {"tracks": [[100.0, 100.5, [(1, 0.0, 0.0)]], [100.06, 100.1, []]]}, [], [])
        other = Result(500.0, {"tracks": [[500.0, 500.1, [(4, 0.0, 0.03)]]]}, [], [])
        same = machines.sameness(one, other)
        self.assertEqual((same["lists"], same["lists_missing"], same["tracks"], same["unpaired"]), (2, 1, 1, 0))
        self.assertAlmostEqual(same["median_m"], 0.03)
        self.assertEqual(set(by_time(one, "tracks")), {0, 60})
        self.assertAlmostEqual(latencies(one, "tracks")[1], 0.04)

    def test_measurements_before_the_kill_are_no_recovery(self):
        result = Result(0.0, {"risks": [[9.9, 10.1, []], [10.5, 12.0, []], [10.6, 12.1, []]]}, [], [])
        self.assertAlmostEqual(recovery(result, ("risk", 10.0)), 2.0)
        self.assertIsNone(recovery(result, ("risk", 11.0)))


if __name__ == "__main__":
    unittest.main()
