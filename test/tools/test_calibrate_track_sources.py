#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate calibrate_track_sources on drives of one second that are counted by hand."""

import contextlib
import io
import math
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import yaml

from datmo_tools.evaluate.main import main
from datmo_tools.evaluate.source_tally import DetectionLaw, Share, SourceTally
from datmo_tools.evaluate.track_frames import Scene
from datmo_tools.evaluate.track_lists import read_track_lists
from datmo_tools.evaluate.truth import ANY, Region
from track_samples import FRAMES, SPEED, car, track, view, write_run

DRIVING = car(1, 20.0, 0.0, SPEED)
HALF = range(5, FRAMES)  # the frames in which the camera has a track of it


class Tool(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.bag, self.table = self.folder / "run.bag", self.folder / "sources.yaml"

    def write(self, lidar=(), stereo=(), views=None):
        lists = {"/tracks/lidar": lidar, "/tracks/stereo": stereo, "/tracks": lidar}
        write_run(self.bag, lists, [DRIVING], [view()] if views is None else views)

    def run_tool(self, *words, code=0):
        """Returns output, errors, and the sections that it writes (None: it fails)."""
        out, errors = io.StringIO(), io.StringIO()
        words = ["calibrate_track_sources", self.bag, "--sources", "stereo", "--out", self.table, *words]
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            found = main([str(word) for word in words])
        self.assertEqual(found, code, errors.getvalue())
        if code:
            return out.getvalue(), errors.getvalue(), None
        return out.getvalue(), "", yaml.safe_load(self.table.read_text())["track_fusion"]["sources"]

    def test_shares_by_hand(self):
        """It tracks the car in the later frames, which count more:
        the car could be seen for longer."""
        self.write([track(7, 20.0, 0.0, SPEED)], [track(4, 20.0, 0.0, SPEED, HALF)])
        out, _, sections = self.run_tool("--min-frames", "1", "--min-tracks", "1")
        seen = [1.0 - math.exp(-0.1 * frame) for frame in range(FRAMES)]
        share = Share(sum(seen[frame] for frame in HALF), sum(seen)).value
        self.assertIn(f"{share:.3f}", out)
        # Its one track, of no class, is true.
        self.assertEqual(sections["stereo"]["true_share"], {"other": round(2 / 3, 3)})
        self.assertNotIn("pedestrian", sections["stereo"]["detection"])
        law = DetectionLaw(**sections["stereo"]["detection"]["vehicle"])
        self.assertAlmostEqual(float(law.at(26.0)), (share * (sum(seen) + 2) - 1) / sum(seen), 1)

    def test_hidden_objects_are_not_required(self):
        self.write([track(7, 20.0, 0.0, SPEED)], [track(4, 20.0, 0.0, SPEED, HALF)], [view(10.0)])
        _, _, sections = self.run_tool("--min-frames", "1")
        self.assertNotIn("detection", sections["stereo"])

    def test_agreement_with_false_tracks_of_another_source(self):
        """Of the scanner's 11 frames of a ghost the camera has a track there in 6."""
        self.write([track(7, 15.0, 8.0)], [track(4, 15.5, 8.0, 0.0, HALF)])
        lists = read_track_lists(self.bag, ["/tracks/lidar", "/tracks/stereo"])
        scene = Scene(self.bag, self.bag, Region(50.0), ANY, 2.0)
        frames = {topic: scene.frames(topic, items) for topic, items in lists.items()}
        tally = SourceTally(5.0)
        tally.add_agreement(frames["/tracks/stereo"], frames["/tracks/lidar"], 2.0)
        self.assertEqual(tally.false_agreement, Share(6, 11))

    def test_few_frames_are_left_out(self):
        self.write([track(7, 20.0, 0.0, SPEED)], [track(4, 20.0, 0.0, SPEED, HALF)])
        _, _, sections = self.run_tool("--min-frames", "50", "--min-tracks", "2")
        self.assertEqual(sections, {"stereo": {}})

    def test_plot(self):
        self.write([track(7, 20.0, 0.0, SPEED)], [track(4, 20.0, 0.0, SPEED, HALF)])
        plot = self.folder / "sources.svg"
        self.run_tool("--plot", plot)
        self.assertIn("Frames of false tracks a minute", plot.read_text())
        _, errors, _ = self.run_tool("--plot", self.folder / "sources.txt", code=1)
        self.assertIn("expected a name that ends in", errors)

    def test_without_views_it_ends(self):
        self.write([track(7, 20.0, 0.0, SPEED)], [track(4, 20.0, 0.0, SPEED)], [])
        _, errors, _ = self.run_tool(code=1)
        self.assertIn("expected views", errors)


class Law(unittest.TestCase):
    def test_is_found_again(self):
        tally = SourceTally(5.0)
        law = DetectionLaw(0.8, 23.0)
        for index in range(10):
            tally.visible["cyclist", index] = 400
            tally.found["cyclist", index] = 400 * float(law.at(tally.center(index)))
        found = tally.law("cyclist")
        self.assertAlmostEqual(found.near, law.near, 2)
        self.assertAlmostEqual(found.half_range, law.half_range, 1)

    def test_a_share_is_never_sure(self):
        self.assertEqual(Share(0, 0).value, 0.5)
        self.assertEqual(Share(8, 8).value, 0.9)

    def test_false_frames_a_minute(self):
        tally = SourceTally(5.0)
        tally.seconds = 30.0
        tally.false = Counter({2: 4})
        self.assertEqual(tally.false_per_minute(2), 8.0)
        self.assertEqual(tally.false_per_minute(0), 0.0)


if __name__ == "__main__":
    unittest.main()
