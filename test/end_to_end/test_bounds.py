#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How bounds of the end-to-end tests are computed from figures, and applied to them."""

import io
import tempfile
import unittest
from contextlib import redirect_stdout
from pathlib import Path
from unittest import mock

import bounds
import yaml
from scene_figures import REQUIRED, SCENES

# pose_error: less is better; mota: more is.
MEASURED = {
    "seeds": 3,
    "figures": {name: {"median": 0.0, "worst": 0.0, "bound": bound}
                for name, bound in (("missed", 0.0), ("mota", 0.5), ("pose_error", 0.004))},
    "expected_failures": {3: ["missed"]},
}  # fmt: skip


class Bounds(unittest.TestCase):
    def test_a_bound_is_as_far_from_the_worst_as_that_from_the_median(self):
        self.assertEqual(bounds.bound_of("pose_error", [1.0, 2.0, 4.0]), (2.0, 4.0, 6.0))
        median, worst, bound = bounds.bound_of("mota", [0.9, 0.8, 0.6])
        self.assertEqual((median, worst), (0.8, 0.6))
        self.assertAlmostEqual(bound, 0.4)

    def test_what_is_always_equal_must_not_change(self):
        self.assertEqual(bounds.bound_of("missed", [0, 0, 0]), (0.0, 0.0, 0.0))
        self.assertFalse(bounds.is_within("missed", 1, 0.0))

    def test_no_bound_is_negative(self):
        self.assertEqual(bounds.bound_of("judged", [10.0, 4.0, 1.0])[2], 0.0)

    def test_rounding_of_a_bound_fails_nothing(self):
        self.assertTrue(bounds.is_within("pose_error", 0.0040004, 0.004))
        self.assertFalse(bounds.is_within("pose_error", 0.00402, 0.004))
        self.assertTrue(bounds.is_within("mota", 0.4999, 0.5))

    def test_every_scene_has_bounds_of_all_required_figures(self):
        measured = yaml.safe_load(bounds.FILE.read_text(encoding="utf-8"))["scenes"]
        self.assertEqual(set(measured), set(SCENES))
        for scene, required in REQUIRED.items():
            self.assertLessEqual(set(required), set(measured[scene]["figures"]), scene)


class Check(unittest.TestCase):
    """The intersection, which requires missed 0 and a pose error of 0.01."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        file = Path(folder.name) / "bounds.yaml"
        file.write_text(yaml.safe_dump({"scenes": {"intersection": MEASURED}}), encoding="utf-8")
        patched = mock.patch.object(bounds, "FILE", file)
        patched.start()
        self.addCleanup(patched.stop)

    def failures(self, seed, **figures):
        """Returns the failures of a test that checks these figures."""
        figures = {"missed": 0, "mota": 0.6, "pose_error": 0.003, **figures}

        class Scene(unittest.TestCase):
            def runTest(self):
                bounds.check(self, "intersection", seed, figures)

        result = unittest.TestResult()
        with redirect_stdout(io.StringIO()) as said:
            Scene().run(result)
        self.assertEqual(result.errors, [])
        return len(result.failures), said.getvalue()

    def test_within(self):
        self.assertEqual(self.failures(1), (0, ""))

    def test_beyond(self):
        self.assertEqual(self.failures(1, mota=0.4, pose_error=0.005)[0], 2)

    def test_an_expected_failure_is_reported_and_fails_nothing_else(self):
        count, said = self.failures(3, missed=1, mota=0.4)
        self.assertEqual(count, 1)
        self.assertIn("seed 3, missed: 1, an expected failure", said)

    def test_figures_that_were_not_measured(self):
        self.assertEqual(self.failures(1, more=1.0)[0], 1)


if __name__ == "__main__":
    unittest.main()
