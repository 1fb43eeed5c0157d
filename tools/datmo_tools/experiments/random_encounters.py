# SPDX-License-Identifier: BSD-3-Clause
"""Draws random encounters, variations of those of the protocols (encounter_scenes.py)."""

import numpy as np

from datmo_tools.experiments.encounter_scenes import ENDINGS, MEETING, PROTOCOLS, Encounter, scene

SLOWER = 5.0  # km/h, below a protocol's lowest speed of the host; it still catches up with who is ahead
FASTEST = 60.0  # km/h, of the host


def random_scenes(count, seed):
    """Yields `count` scenes (dicts) with random speeds, times and places near those of the
    protocols, and road users and hosts that change their behavior: whether they meet is random."""
    random = np.random.default_rng(seed)
    protocols = [name for name in PROTOCOLS if not name.startswith("turn")]
    for number in range(count):
        protocol = protocols[number % len(protocols)]
        host = random.uniform(min(PROTOCOLS[protocol]) - SLOWER, FASTEST)
        host = 50.0 if protocol.startswith("car_braking") else host
        drawn = scene(Encounter(protocol, host, str(random.choice(ENDINGS))), int(number + 1))
        drawn["options"]["scanner"] = {"beam_spacing": 1.0}
        drawn["options"]["ground_truth"] = {"radius": 45.0}
        yield _varied(drawn, random)


def _varied(drawn, random):
    """Shifts times by seconds; the other stops or changes speed, the host brakes or speeds up."""
    actor = drawn["actors"][0]
    shift = random.uniform(-2.0, 2.0)
    actor["speed"] = [[max(0.0, t + shift) if t > 0.0 else 0.0, v] for t, v in actor["speed"]]
    actor["speed"] = _rising(actor["speed"])
    if random.uniform() < 0.3:
        actor["speed"] = _changed(actor["speed"], random, float(random.choice([0.0, 0.5, 1.5])))
    ego = drawn["ego"]
    if random.uniform() < 0.3:
        ego["speed"] = _changed(ego["speed"], random, float(random.choice([0.0, 0.5, 1.2])))
    return drawn


def _changed(profile, random, factor):
    """Changes the speed at some time to a multiple of it, within one to three seconds."""
    begin = random.uniform(2.5, MEETING + 1.0)
    speed = _speed_at(profile, begin)
    kept = [point for point in profile if point[0] < begin]
    return kept + [[begin, speed], [begin + random.uniform(1.0, 3.0), factor * speed]]


def _speed_at(profile, time):
    return float(np.interp(time, [t for t, _ in profile], [v for _, v in profile]))


def _rising(profile):
    """Drops points that the shift has moved before their predecessor."""
    result = []
    for time, speed in profile:
        if result and time <= result[-1][0]:
            time = result[-1][0] + 0.01
        result.append([time, speed])
    return result
