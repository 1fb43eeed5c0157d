#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/figures: how figures are summarized."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from datmo_tools.errors import InputError
from datmo_tools.figures import cameras, data_sets, maps, mono, recordings, risk
from datmo_tools.figures.class_figures import class_figures
from datmo_tools.figures.network import NETWORK
from datmo_tools.figures.step import Bench, preset
from datmo_tools.yaml_files import load_yaml
from folder_case import InFolder

ROOT = Path(__file__).resolve().parents[2]


class KittiSpeed(unittest.TestCase):
    def test_rates_that_the_program_prints(self):
        said = ("4100 frames; 1990 frames/s by the trackers of all three classes, "
                "1500 with the vehicle's motion; one core\n")  # fmt: skip
        self.assertEqual(recordings.frames_per_second(said),
                         {"trackers": 1990, "with_ego_motion": 1500})  # fmt: skip

    def test_other_output_is_refused(self):
        with self.assertRaisesRegex(InputError, "expected frames/s"):
            recordings.frames_per_second("4100 frames\n")


class Preset(InFolder):
    def test_settings_are_in_the_file_that_run_bag_is_told(self):
        option, file = preset(self.folder, recordings.NO_ODOMETRY)
        self.assertEqual((option, load_yaml(file)), ("--preset", {"motion": {"source": "none"}}))


class Pooled(unittest.TestCase):
    """Two data sets of one seed, pooled."""

    def result(self, misses, required, delays):
        counts = dict.fromkeys(data_sets.COUNTS, 1)
        counts.update(misses=misses, required=required, intersections_found=None)
        objects = [
            {"class": "vehicle", "found": delay is not None, "delay_s": delay,
             "attainable_delay_s": 0.1, "delay_ratio": 2.0} for delay in delays]  # fmt: skip
        return {"figures": {"runs": {"with": counts}}, "objects": objects}

    def test_counts_are_added_up_before_shares_are_taken(self):
        # (10 + 28 misses, 2 false, 2 switches) of 100 + 100.
        pooled = data_sets.pooled([self.result(10, 100, [0.2]), self.result(28, 100, [0.6, None])])
        self.assertAlmostEqual(pooled["runs"]["with"]["mota"], 1.0 - 42.0 / 200.0)
        self.assertEqual(pooled["runs"]["with"]["missed_objects"], 2)

    def test_delays_are_of_found_objects(self):
        delays = data_sets.pooled([self.result(0, 1, [0.2]), self.result(0, 1, [0.6, None])])
        vehicles = delays["delays"]["vehicle"]
        self.assertEqual((vehicles["objects"], vehicles["found"]), (3, 2))
        self.assertAlmostEqual(vehicles["delay_s"], 0.4)
        self.assertIsNone(delays["delays"]["cyclist"]["delay_s"])


class FusionFigures(unittest.TestCase):
    """Two drives with two seeds, and one that was driven only once."""

    def run_of(self, drive, seed, misses, mota):
        counts = {"moving_objects": 10, "missed_objects": 1, "tracks": 12, "false_tracks": 2,
                  "required": 100, "misses": misses, "false_positives": 5, "id_switches": 1}  # fmt: skip
        run = drive if seed is None else f"data_set_{drive}_{seed}"
        return {"drive": drive, "run": run, "camera": seed, "tracks": None,
                "levels": {"none": {**counts, "mota": mota}}}  # fmt: skip

    def setUp(self):
        self.found = cameras.fusion_figures([
            self.run_of("1", 1, 34, 0.6), self.run_of("1", 2, 14, 0.8),
            self.run_of("2", 1, 54, 0.4), self.run_of("2", 2, 24, 0.7),
            self.run_of(cameras.KITTI, None, 4, 0.9)])  # fmt: skip

    def test_each_drive_has_the_spread_of_its_seeds(self):
        drives = self.found["drives"]
        self.assertEqual(drives["1"]["levels"]["none"]["mota"], [0.7, 0.6, 0.8])
        self.assertEqual(drives["1"]["camera"], 1)
        self.assertEqual(drives[cameras.KITTI]["levels"]["none"]["misses"], [4, 4, 4])

    def test_simulated_drives_of_a_seed_are_taken_together(self):
        together = self.found["all"]["none"]
        self.assertEqual(together["misses"], [63, 38, 88])
        self.assertEqual(together["mota"], [0.625, 0.5, 0.75])
        self.assertEqual(together["false_tracks"], [4, 4, 4])


class RiskFigures(unittest.TestCase):
    def test_warnings_of_all_data_sets_are_added_up(self):
        drives = [("traffic", {"warnings": 3, "seconds": 100.0}), ("traffic", {"warnings": 1, "seconds": 50.0})]
        kitti = (risk.DRIVE, {"warnings": 2, "seconds": 16.0})
        found = risk.figures([("own", {"futures": {}}), *drives, kitti, ("true", {})])
        self.assertEqual(found["traffic"], {"warnings": 4, "seconds": 150.0})
        self.assertEqual(found[risk.DRIVE], {"warnings": 2, "seconds": 16.0})
        self.assertEqual(sorted(found), ["drive_0005", "own", "traffic", "true"])

    def test_the_drive_is_left_out_without_its_data(self):
        for folder in (None, risk.DRIVE_0005):
            with tempfile.TemporaryDirectory() as data:
                if folder:
                    (Path(data) / folder).mkdir(parents=True)
                bench = Bench(Path(), Path(), Path(), Path(data), (1,))
                names = [job.name for job in risk.jobs(bench)]
                self.assertEqual(risk.DRIVE in names, folder is not None)


class MapFigures(unittest.TestCase):
    def test_sets_have_a_spread_and_the_other_jobs_their_own_figures(self):
        found = maps.figures([
            ("2", {"map level": {"free_right": 0.5}}), (maps.CHANGES, {"gone": 1}),
            ("2", {"map level": {"free_right": 0.7}})])  # fmt: skip
        self.assertEqual(found["sets"], {"2": {"map level": {"free_right": [0.6, 0.5, 0.7]}}})
        self.assertEqual(found[maps.CHANGES], {"gone": 1})
        self.assertNotIn(maps.DRIVE_KITTI, found)

    def test_every_fifth_parked_vehicle_is_gone(self):
        def row(kinds, **rest):
            return {"kinds": kinds, "from": 0.0, "to": 18.0, "spacing": 6.0, **rest}  # places 0 to 3

        scene = {"speed": 8, "rows": [row(["car"], leave_out=[1]), row(["tree"]), row(["van", "car"])]}
        changed = maps.without_parked(scene)
        # Parked: 0, 2, 3 of the first row, 0 to 3 of the last one.
        self.assertEqual([row.get("leave_out") for row in changed["rows"]], [[1], [], [1]])
        self.assertEqual(scene["rows"][0]["leave_out"], [1])
        self.assertEqual(changed["speed"], 8)


class MonoFigures(InFolder):
    def jobs(self):
        """Returns the names of the jobs, and what is printed."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            found = mono.jobs(Bench(ROOT, self.folder, self.folder, self.folder / "data", (1,)))
        return {job.name for job in found}, said.getvalue()

    def test_the_network_is_left_out_if_its_file_is_missing(self):
        names, said = self.jobs()
        self.assertEqual(names, {"grids", "1_1", "2_1"})
        self.assertRegex(said, "mono: network left out, .*yolox_nano.onnx is not there")
        model = self.folder / NETWORK
        model.parent.mkdir(parents=True)
        model.write_text("")
        names, said = self.jobs()
        self.assertEqual((len(names), said), (3, ""))

    def test_runs_are_by_resolution_and_detector_over_the_seeds(self):
        def run(mota, right):
            scored = {"right": {"vehicle": {"0 to 10 m": [right, 4]}}, "reported": 4, "on_nothing": 1,
                      "calibration": [[0.5, 0.25 * right, 4], [0.95, 1.0, 2]]}  # fmt: skip
            return {"mota": mota, "id_switches": 0, "false_movers_per_frame": 0.0, "delay_mean_s": 0.3,
                    "brief": {"found": 1, "objects": 3}, "class_right": {"vehicle": 1.0}, "tracks": scored}  # fmt: skip

        found = mono.figures([(1, {"none": run(0.9, 1)}), (None, "grids"), (2, {"none": run(0.8, 2)}),
                              (2, {"none": run(0.7, 4), "dnn": run(0.6, 4)})])  # fmt: skip
        self.assertEqual(found["grids"], "grids")
        self.assertEqual([list(detectors) for detectors in found["runs"].values()], [["none", "dnn"], ["none"]])
        none = found["runs"]["2"]["none"]
        self.assertEqual((none["mota"], none["brief"]["found"]), ([0.75, 0.7, 0.8], [1, 1, 1]))
        self.assertEqual((none["class_right"]["vehicle"], none["class_right"]["cyclist"]), ([1.0, 1.0, 1.0], None))
        self.assertEqual(none["tracks"], {"right": {"vehicle": {"0 to 10 m": [6, 8]}}, "reported": 8, "on_nothing": 2,
                                          "calibration": [[0.5, 0.75, 8], [0.95, 1.0, 4]]})  # fmt: skip

    def test_classes_by_range(self):
        def row(vehicle, cyclist):
            return {"vehicle": vehicle, "cyclist": cyclist, "pedestrian": 0}

        table = {"vehicle": row(8, 2), "cyclist": row(1, 3), "pedestrian": row(0, 0), "nothing": row(4, 0)}
        found = class_figures({"bands_m": [[0.0, 10.0]], "confusion": [table],
                                    "calibration": [{"said": 0.8, "right": 0.7, "count": 18}]})  # fmt: skip
        self.assertEqual(found["right"], {"vehicle": {"0 to 10 m": [8, 10]}, "cyclist": {"0 to 10 m": [3, 4]},
                                          "pedestrian": {"0 to 10 m": [0, 0]}})  # fmt: skip
        self.assertEqual((found["reported"], found["on_nothing"]), (18, 4))
        self.assertEqual(found["calibration"], [[0.8, 0.7, 18]])


if __name__ == "__main__":
    unittest.main()
