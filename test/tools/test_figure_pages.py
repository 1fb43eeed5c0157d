#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/figures: how figures are rendered, and that README.md and doc/results.md are what
doc/results.json makes of them."""

import contextlib
import io
import json
import unittest
from pathlib import Path

from datmo_tools.errors import InputError
from datmo_tools.figures import render, results_file, steps
from datmo_tools.figures.main import check, main, write_pages
from datmo_tools.text_table import spread_text
from folder_case import InFolder

ROOT = Path(__file__).resolve().parents[2]
README = f"# A\n\n{render.BEGIN}\nold\n{render.END}\nrest\n"

PEOPLE = {"positions": 153, "found": 132, "found_share": 0.8627, "median_distance_m": 0.17,
          "id_switches": 4, "ids": 12, "never_found": 0}  # fmt: skip


MACHINE = {"processor": "P", "cores": 2}
HORIZONS = ("1", "2", "3", "4")
# Of one method, as in steps.risk; for the first one also the reliability.
RISKS = {
    "drives": 129, "contacts": 43, "ttc_median_s": 0.04, "ttc_95_s": 0.2, "warned": 41, "lead_share": 0.75,
    "lead_median_s": 1.71, "lead_5_s": 0.64,
    "near_misses": 86, "near_misses_warned": 4, "long_seen": {"contacts": 29, "in_time": 19},
    "briefly_seen": {"contacts": 14, "in_time": 5}, "brier": dict.fromkeys(HORIZONS, 0.05),
    "calibration_error": dict.fromkeys(HORIZONS, 0.09), "reliability": [[0.1, 0.05, 30]],
}  # fmt: skip

KITTI = {kind: {overlap: dict.fromkeys(("samota", "amota", "amotp", "mota", "motp", "id_switches",
                                        "fragmentations"), 0.5) for overlap in ("0.25", "0.5", "0.7")}
         for kind in ("Car", "Pedestrian", "Cyclist")}  # fmt: skip


def results(**figures):
    """Returns a file of figures with these steps."""
    done = {name: {"shows": name, "command": "x", "seeds": None, "commit": "0123abcd", "confirmed": None,
                   "date": "2026-01-02", "machine": MACHINE, "job_seconds": 1, "figures": value}
            for name, value in figures.items()}  # fmt: skip
    return {"format": results_file.FORMAT, "commit": "0123abcd", "date": "2026-01-02",
            "machine": MACHINE, "steps": done}  # fmt: skip


class Pages(InFolder):
    def setUp(self):
        super().setUp()
        (self.folder / "README.md").write_text(README)

    def pages(self, **figures):
        return render.rendered(self.folder, results(**figures))

    def test_table_is_between_the_marks(self):
        text = self.pages(people=PEOPLE)["README.md"]
        self.assertIn("132 of 153 (86 %), 4 id switches", text)
        self.assertTrue(text.startswith(f"# A\n\n{render.BEGIN}\n| what |"))
        self.assertTrue(text.endswith(f"{render.END}\nrest\n"))
        self.assertNotIn("old", text)

    def test_unmeasured_figures_are_left_out(self):
        pages = self.pages(people=PEOPLE)
        self.assertIn("## People around a robot", pages["doc/results.md"])
        self.assertNotIn("Indoors", pages["doc/results.md"])
        self.assertIn("`0123abcd`", pages["doc/results.md"])

    def test_steps_name_the_commit_of_their_measurement(self):
        made = results(people=PEOPLE)
        made["steps"]["people"]["commit"] = "89abcdef"
        pages = render.rendered(self.folder, made)
        self.assertIn("All figures are of commit `0123abcd`", pages["doc/results.md"])
        self.assertIn("| `people` | people | `x` |  | `89abcdef` | 0.0 |", pages["doc/results.md"])
        self.assertIn("All by `scripts/figures`, of commit `0123abcd`", pages["README.md"])

    def test_steps_of_an_older_file_are_of_its_commit_and_machine(self):
        made = results(people=PEOPLE)
        for key in ("commit", "machine"):
            del made["steps"]["people"][key]
        file = self.folder / "results.json"
        file.write_text(json.dumps(made))
        self.assertEqual(results_file.read(file), results(people=PEOPLE))

    def test_loops_are_shown_where_they_were_measured(self):
        scored = {"translation_m": {"mean": 0.5, "std": 0.1}, "rotation_deg": {"mean": 1, "std": 2}}
        run = {"odometry": scored, "pose": scored, "relations": 9, "scans": 7, "median_time_ms": 0.5}
        before = self.pages(slam={"intel": run})
        self.assertIn("0.500 m, 1.00 deg |", before["README.md"])
        self.assertNotIn("loops closed", before["README.md"] + before["doc/results.md"])
        loops = {**scored, "translation_m": {"mean": 0.25, "std": 0.1}}
        after = self.pages(slam={"intel": {**run, "loops_closed": loops, "relations_of_loops": 8}})
        self.assertIn("1.00 deg; with loops closed 0.250 m |", after["README.md"])
        self.assertIn("| | | 8 | `loop_closing`, at the end | 0.250 ± 0.100 |", after["doc/results.md"])
        self.assertIn("with loops closed", after["doc/results.md"])

    def test_maps_by_level(self):
        shares = dict.fromkeys(("occupied_right", "free_right", "things_found", "poles_found"), [0.9, 0.8, 1.0])
        kinds = dict.fromkeys(("vanished", "new"), {"cells": 9, "cells_right": 7, "things": 3,
                                                    "things_reported": 2, "wrong_cells": 1.5})  # fmt: skip
        levels = {"scanner alone": shares, "map level": {**shares, "conflicts": [11.0, 10.0, 12.0]}}
        found = {"sets": {"1": levels}, "changes": {"gone": kinds}}
        done = results(maps=found)
        done["steps"]["maps"]["seeds"] = [1, 2]
        page = render.rendered(self.folder, done)["doc/results.md"]
        self.assertIn("| data set 1 | scanner alone | 0.900 (0.800 to 1.000) |", page)
        self.assertIn("| 0.900 (0.800 to 1.000) | 11 (10 to 12) |", page)
        self.assertIn("| a fifth is gone | 9 | 7 | 3 | 2 | 9 | 2, 2 |", page)
        self.assertNotIn("Velodyne", page)

    def test_a_single_camera_with_and_without_a_network(self):
        scored = {"right": {kind: {"0 to 10 m": [3, 4]} for kind in ("vehicle", "cyclist", "pedestrian")},
                  "reported": 9, "on_nothing": 2, "calibration": [[0.8, 0.7, 9]]}  # fmt: skip
        run = {"mota": [0.883, 0.87, 0.9], "id_switches": [0, 0, 1], "false_movers_per_frame": [0.01, 0.01, 0.01],
               "delay_mean_s": [0.31, 0.31, 0.31], "brief": {"objects": [3, 3, 3], "found": [1, 1, 1]},
               "class_right": {"cyclist": [1.0, 1.0, 1.0], "vehicle": [0.99, 0.99, 0.99]}, "tracks": scored}  # fmt: skip
        grids = {"mono": {"5 to 10 m": {"precision": 0.997, "recall": 0.69}}}

        def page(runs):
            done = results(mono={"runs": runs, "grids": grids})
            done["steps"]["mono"]["seeds"] = [1, 2]
            return render.rendered(self.folder, done)["doc/results.md"]

        without = page({"2": {"none": run}})
        self.assertIn("medians over 2\nseeds", without)
        self.assertIn("| 2 deg | none | 88.3 (87.0 to 90.0) | 0 (0 to 1) | 0.01 | 1 of 3 | 0.31 | 100.0, 99.0 | 2 of 9 |",
                      without)  # fmt: skip
        self.assertIn("| `/grids/mono` | 99.7, 69.0 |", without)
        self.assertNotIn("YOLOX", without)
        with_network = page({"2": {"none": run, "dnn": {**run, "objects": scored, "alone": scored}}})
        self.assertIn("| cyclist | 75 of 4 |", with_network)
        self.assertIn("Of 9 classified objects 2 are where the labels have nothing, of 9\nfrom the image alone 2.",
                      with_network)  # fmt: skip
        self.assertIn("| tracks | 80 | 70 | 9 |", with_network)

    def test_wrong_classes_beside_the_scanner_alone(self):
        run = {"mota": [0.75, 0.5, 1.0], "misses": [5, 4, 6], "required": [100, 90, 110], "missed_objects": [0, 0, 1],
               "moving_objects": [9, 9, 9], "id_switches": [2, 1, 3], "class_right": [0.75, 0.5, 1.0],
               "class_right_by_range": {"0 to 10 m": [0.75, 0.75, 0.75], "10 to 20 m": None}}  # fmt: skip
        done = results(wrong_classes={"scanner alone": run, "0.2": run})
        done["steps"]["wrong_classes"]["seeds"] = [1, 2]
        page = render.rendered(self.folder, done)["doc/results.md"]
        self.assertIn("road borders and 2 seeds", page)
        self.assertIn("| id switches | class right, % of frames | 0 to 10 m | 10 to 20 m |\n|---|---|---|---|---|---|---|---|\n",
                      page)  # fmt: skip
        figures = ("75.0 (50.0 to 100.0) | 5 (4 to 6) of 100 (90 to 110) | 0 (0 to 1) of 9 | 2 (1 to 3) | "
                   "75.0 (50.0 to 100.0) | 75.0 | - |")  # fmt: skip
        self.assertIn(f"| scanner alone | {figures}\n| 20 | {figures}\n", page)

    def test_risks_by_tracks_and_method(self):
        methods = dict.fromkeys(("futures", "thesis", "ttc_boxes", "rss"), RISKS)
        traffic = {"warnings": 8, "seconds": 410.0}
        pages = self.pages(risk={"true": methods, "own": methods, "random": methods, "traffic": traffic})
        self.assertIn("7 min | 19 of 29; 4 of 86; 8 | `x`, `run_bag --risk` |", pages["README.md"])
        page = pages["doc/results.md"]
        self.assertIn("| own | `futures` (ours) | 0.04, 0.20 | 19 of 29 | 5 of 14 | 0.75 | 4 of 86 |", page)
        self.assertEqual(page.count("0.050, 0.050, 0.050, 0.050 | 0.090 |"), 8)
        self.assertIn("| 10 | 5 | 30 |", page)
        row = ("| `rss` | 0.04, 0.20 | 41 of 43 | 19 of 29 | 5 of 14 | 1.71, 0.64 | 0.75 | 4 of 86 | "
               "0.050, 0.050, 0.050, 0.050 | 0.090, 0.090, 0.090, 0.090 |")
        self.assertIn(row, page)
        self.assertNotIn("drive 0005 (", page)

    def test_warnings_on_kittis_drive_are_shown_if_measured(self):
        methods = dict.fromkeys(("futures", "thesis", "ttc_boxes", "rss"), RISKS)
        drives = dict.fromkeys(("traffic", "drive_0005"), {"warnings": 3, "seconds": 16.0})
        page = self.pages(risk={"true": methods, "own": methods, "random": methods, **drives})["doc/results.md"]
        self.assertIn("On KITTI's drive 0005 (16 s without contact, a beam every 2 degrees) there are 3.", page)

    def test_speed_and_frames_per_second_only_where_measured(self):
        latency = dict.fromkeys(("median", "percentile_99", "worst"), 3.0)
        run = {"scans": 1, "unanswered": 0, "latency_ms": latency, "cpu_share": 0.25,
               "memory_peak_mib": 174.4, "memory_growth_mib": 0.5}  # fmt: skip
        risk = {"assessRisks/30": {"median": 5600.0, "percentile_99": 7200.0}}
        speed = {"live": {"demonstrator": run}, "limits": {}, "cpu_us": {}, "percentiles_us": risk}
        without = self.pages(speed=speed, kitti_tracking=KITTI)["doc/results.md"]
        self.assertNotIn("frames/s", without)
        self.assertIn("| demonstrator | 1 | 0 | 3.0 | 3.0 | 3.0 | 0.25 | 174 |", without)
        self.assertIn("`assessRisks/30`, of each call: median 5600 µs, 99 % 7200 µs.", without)
        rates = {"trackers": 1990, "with_ego_motion": 1500}
        page = self.pages(speed=speed, kitti_tracking={**KITTI, "frames_per_second": rates})
        self.assertIn("1990 frames/s, 1500 with the vehicle's motion", page["doc/results.md"])

    def test_rendered_twice_is_the_same(self):
        write_pages(self.folder, results(people=PEOPLE))
        first = (self.folder / "README.md").read_text()
        write_pages(self.folder, results(people=PEOPLE))
        self.assertEqual((self.folder / "README.md").read_text(), first)

    def test_check_names_pages_that_are_stale(self):
        made = results(people=dict(PEOPLE))
        write_pages(self.folder, made)
        (self.folder / render.FILE).write_text(results_file.as_text(made))
        self.assertEqual(check(self.folder), 0)
        made["steps"]["people"]["figures"]["found"] = 131
        (self.folder / render.FILE).write_text(json.dumps(made))
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(check(self.folder), 1)
        self.assertIn("doc/results.md: does not agree with doc/results.json", said.getvalue())

    def test_readme_without_marks_is_refused(self):
        (self.folder / "README.md").write_text("# A\n")
        with self.assertRaisesRegex(InputError, "expected the table there"):
            self.pages(people=PEOPLE)

    def test_figures_as_a_reader_sees_them(self):
        self.assertEqual(spread_text([2, 1, 3]), "2 (1 to 3)")
        self.assertEqual(spread_text([2.01, 2.0, 2.04], 1), "2.0")
        self.assertEqual(render.percent_spread([0.5, 0.25, 0.75]), "50 (25 to 75)")
        self.assertEqual(spread_text(None), "-")
        self.assertEqual(render.percent(0.1234, 1), "12.3")
        self.assertEqual(render.degrees(3.14159265), "180.0")

    def test_lists_of_numbers_take_one_line(self):
        text = results_file.as_text({"a": [1.5, -2, None], "b": [{"c": 1}]})
        self.assertIn('"a": [1.5, -2, null]', text)
        self.assertEqual(json.loads(text), {"a": [1.5, -2, None], "b": [{"c": 1}]})


class CommandLine(unittest.TestCase):
    def run_main(self, *words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(["--source", str(ROOT), *words])
        return code, out.getvalue() + err.getvalue()

    def test_steps_are_listed(self):
        code, said = self.run_main("--list")
        self.assertEqual(code, 0)
        for step in steps.STEPS:
            self.assertIn(step.name, said)

    def test_unknown_step(self):
        code, said = self.run_main("--only", "luck")
        self.assertEqual(code, 1)
        self.assertIn("luck: no such step, expected kitti_tracking, ", said)

    @unittest.skipUnless((ROOT / render.FILE).is_file(), "scripts/figures has not been run here")
    def test_the_repositorys_pages_are_what_its_figures_make_of_them(self):
        code, said = self.run_main("--check")
        self.assertEqual(code, 0, said)


if __name__ == "__main__":
    unittest.main()
