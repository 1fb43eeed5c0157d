#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Track-level fusion (thesis 3.4) on the simulated intersection: objects tracked by both scanner
and stereo camera soon become one track with one id, and in the camera's view there are no more
false tracks than with the scanner alone. Two seeds are used, so that the result does not depend on
chance.
"""

import tempfile
import unittest
from pathlib import Path

from bounds import check, seeds
from datmo_tools.evaluate.track_lists import read_track_lists
from scene_figures import fused_tracks, of_fused_tracks


def source_pairs(lists):
    """Returns a dictionary ((source, id), ...) of fused tracks of two sources -> their ids."""
    ids = {}
    for item in lists:
        for track in item.tracks:
            if len(track.sources) > 1:
                ids.setdefault(tuple(sorted(track.sources)), set()).add(track.id)
    return ids


class TrackFusion(unittest.TestCase):
    def test_objects_tracked_by_both_are_one_true_track(self):
        frames = {"fused": 0, "lidar": 0}
        for seed in seeds("track_fusion"):
            with self.subTest(seed=seed), tempfile.TemporaryDirectory() as folder:
                result, computed = fused_tracks(Path(folder), seed)
                check(self, "track_fusion", seed, of_fused_tracks(result))
                self.check_passed(result)
                self.check_ids(result, read_track_lists(computed, ["/tracks"])["/tracks"])
                self.assertTrue(result["false"]["views"], "without a view nothing is in it")
                for name in frames:
                    frames[name] += result["false"][name]["in_view_frames"]
        # Over all seeds together: the scanner alone has none to five such tracks in a seed.
        self.assertLessEqual(frames["fused"], frames["lidar"])

    def check_passed(self, result):
        passed = result["passed"]
        self.assertEqual(passed["true_movers"], passed["judged"], passed["false"])
        # Of what both track for at least that long.
        followed = result["objects"]["followed_by_all"]
        self.assertEqual(followed["for_that_long"]["in_time_share"], 1.0, followed["late_or_never"])

    def check_ids(self, result, fused):
        for pair, ids in source_pairs(fused).items():
            self.assertEqual(len(ids), 1, pair)
        for item in fused:
            ids = [track.id for track in item.tracks]
            self.assertEqual(len(ids), len(set(ids)), item.stamp)
            members = [member for track in item.tracks for member in track.sources]
            self.assertEqual(len(members), len(set(members)), item.stamp)
        ghosts = result["ghosts"]
        self.assertLessEqual(ghosts["fused"]["id_switches"], ghosts["lidar"]["id_switches"])


if __name__ == "__main__":
    unittest.main()
