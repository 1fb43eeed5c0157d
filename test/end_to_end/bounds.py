# SPDX-License-Identifier: BSD-3-Clause
"""Bounds of the figures of simulated scenes and of recordings, from their spread over seeds, in
bounds.yaml, which measure_bounds.py writes.

A bound is as far beyond the worst of the measured seeds as that is beyond their median: three
standard deviations of a normal figure, if ten seeds were measured. If a scene requires more
(REQUIRED in scene_figures.py), that counts, and seeds that miss it are kept as expected failures.
"""

import statistics
from pathlib import Path

import yaml
from scene_figures import HIGHER, REQUIRED

FILE = Path(__file__).with_name("bounds.yaml")
DEFAULT_TESTED = 2  # seeds of a scene that the tests run, from 1
TESTED = {"intersection": 3, "without_odometry": 3, "low_level_fusion": 1}  # of others
DIGITS = 3  # significant ones of a bound


def bound_of(name, values):
    """Returns (median, worst, bound) of a figure measured with several seeds."""
    sign = -1.0 if name in HIGHER else 1.0
    costs = [sign * value for value in values]
    median, worst = statistics.median(costs), max(costs)
    bound = sign * (2.0 * worst - median)
    return sign * median, sign * worst, max(bound, 0.0)


def is_within(name, value, bound):
    """Returns whether a figure is as good as its bound, or better."""
    rounding = 10.0**-DIGITS * abs(bound)
    return value >= bound - rounding if name in HIGHER else value <= bound + rounding


def misses_required(scene, figures):
    """Returns the names of the figures that are worse than what is required of the scene."""
    required = REQUIRED.get(scene, {})
    return [name for name in required if not is_within(name, figures[name], required[name])]


def seeds(scene):
    """Returns the seeds of a scene that the tests run: as many as their time allows."""
    return range(1, TESTED.get(scene, DEFAULT_TESTED) + 1)


def check(test, scene, seed, figures):
    """Fails the test (TestCase) for each figure of the scene that is worse than its bound."""
    measured = _read()["scenes"][scene]
    test.assertEqual(set(figures), set(measured["figures"]), "measure_bounds.py knows others")
    expected = measured.get("expected_failures", {}).get(seed, [])
    missed = misses_required(scene, figures)
    for name, value in figures.items():
        with test.subTest(scene=scene, seed=seed, figure=name):
            if name in expected:
                print(f"{scene}, seed {seed}, {name}: {value:g}, an expected failure")
                continue
            bound = measured["figures"][name]["bound"]
            test.assertTrue(is_within(name, value, bound), f"{value:g}, expected {bound:g}")
            test.assertNotIn(name, missed, f"{value:g}")


def _read():
    return yaml.safe_load(FILE.read_text(encoding="utf-8"))
