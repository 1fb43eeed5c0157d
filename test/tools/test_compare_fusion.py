#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""compare_fusion: its table, worked out by hand, and its runs with stand-in programs."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

from datmo_tools.experiments.camera_view import LIST_PARAMETERS, CameraView, camera_view
from datmo_tools.experiments.compare_fusion import main
from datmo_tools.errors import InputError
from datmo_tools.experiments.fusion_comparison import comparison_table, figures, objects_table
from datmo_tools.experiments.fusion_drives import within
from datmo_tools.evaluate.thesis_tables import PUBLISHED

TIMES = {"grid_slam": {"runs": 10, "mean_s": 0.002}, "stereo_objects": {"runs": 5, "mean_s": 0.01},
         "stereo_image_proc": {"runs": 10, "mean_s": 1.0}}  # fmt: skip


def tracked(number, frames, ids):
    """Of score_run, an object that moved for ten frames."""
    return {"id": number, "label": "Van", "class": "vehicle", "first_s": 0.0, "last_s": 1.0,
            "required_frames": 10, "tracked_frames": frames, "track_ids": ids,
            "delay_s": 0.1 if frames else None}  # fmt: skip


def report(moving, missed, false=15):
    """The parts of a score_run report that are read."""
    return {
        "thesis": {"moving_objects": moving, "missed_objects": missed, "tracks": 42,
                   "false_tracks": false},
        "clear_mot": {"mota": 0.5, "required": 100, "misses": 30, "false_positives": 19,
                      "id_switches": 1}, "identity": {"idf1": 0.625},
        "errors": {"position_rmse_m": 0.456},
        "near_errors": {"position_rmse_m": 0.123}, "classes": {"right_share": 0.8},
        "delay": {"mean_s": 0.75},
        "objects": [tracked(7, 9, [3]), tracked(8, 5, [4, 6]), tracked(9, 0, [])],
    }  # fmt: skip


def rows(text):
    """Returns the words of the table's lines below its headings."""
    lines = [line.split() for line in text.splitlines()]
    return lines[next(i for i, line in enumerate(lines) if line[:2] == ["drive", "level"]) + 1:]


# What list_parameters prints, abridged.
PARAMETERS = """\
## `lidar_grid`

| `effective_range` | m | 50 | 1 to 200 | another one's |

## `stereo_camera`, of all nodelets

| parameter | unit | default | range | description |
|---|---|---|---|---|
| `field_of_view` | rad | 1 | 0.1 to 3 | from left to right |
| `effective_range` | m | 36 | 1 to 200 | nothing is said beyond it |

## `tracker`, `stereo_tracker`

| `effective_range` | m | 70 | 1 to 200 | another one's |
"""


class Table(unittest.TestCase):
    def setUp(self):
        self.run = figures(report(30, 4), report(33, 6), report(30, 4, false=3), TIMES)

    def test_all_figures(self):
        text = comparison_table([("set", PUBLISHED[0], "none", [self.run])])
        self.assertEqual(rows(text)[0], [
            "set", "none", "10", "4", "of", "30", "6", "of", "33", "42", "15", "3", "50.0", "62.5",
            "0.46", "0.12", "80.0", "0.75", "7.0"])  # fmt: skip

    def test_thesis_counted_without_and_with_fusion_of_objects(self):
        text = comparison_table([
            ("set", PUBLISHED[2], level, [self.run]) for level in ("none", "low", "object")
        ])  # fmt: skip
        self.assertEqual([row[2] for row in rows(text)], ["7", "-", "4"])

    def test_missing_values(self):
        run = figures(dict(report(5, 3), delay={"mean_s": None}), None, report(5, 3), TIMES)
        text = comparison_table([("drive", None, "none", [run]), ("drive", None, "object", [])])
        first, second = rows(text)
        self.assertEqual(first[2:7], ["-", "3", "of", "5", "-"])
        self.assertEqual(first[-2:], ["-", "7.0"])
        self.assertEqual(second, ["drive", "object"] + 13 * ["-"])

    def test_seeds_are_median_and_range(self):
        runs = [figures(report(30, missed), report(33, 6), report(30, 4), TIMES)
                for missed in (4, 9, 5)]  # fmt: skip
        text = comparison_table([("set", None, "none", runs)])
        self.assertEqual(" ".join(rows(text)[0][3:9]), "5 (4 to 9) of 30")

    def test_objects_by_level(self):
        text = objects_table([("none", self.run), ("low", None), ("object", self.run)])
        self.assertEqual([line.split() for line in text.splitlines()[1:]], [
            ["Van", "7", "0.0", "1.0", "10", "90.0", "90.0"],
            ["Van", "8", "0.0", "1.0", "10", "50.0", "(2", "ids)", "50.0", "(2", "ids)"],
            ["Van", "9", "0.0", "1.0", "10", "0.0", "0.0"],
        ])  # fmt: skip


class Runs(unittest.TestCase):
    """With programs of a few lines of shell that leave their words in the bags."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.out = self.folder / "out"
        self.program("simulate", 'echo "$@" > "$2"')
        self.program("kitti_to_bag", 'echo "$@" > "$2"')
        self.run_bag()
        self.program("list_parameters", f"cat <<'END'\n{PARAMETERS}END")
        self.program("score_run", 'while [ "$1" != --out ]; do\n'
                                  'case "$1" in *=scanner) beam=1;; *angle=0.6) view=1;; esac\n'
                                  'shift; done\n'
                                  f"echo '{json.dumps(report(33, 6))}' > \"$2\"\n"
                                  'if [ -n "$beam" ]; then\n'
                                  f"echo '{json.dumps(report(30, 4))}' > \"$2\"; fi\n"
                                  'if [ -n "$view" ]; then\n'
                                  f"echo '{json.dumps(report(9, 1, 2))}' > \"$2\"; fi")  # fmt: skip
        for name in ("data_set_1.yaml", "data_set_2.yaml", "data_set_3.yaml"):
            (self.folder / name).touch()
        self.config("stereo_camera: {field_of_view: 1.2}")

    def run_bag(self, first="true"):
        """Writes a run_bag that runs `first`, a shell command."""
        self.program("run_bag", f'{first}\necho "$@" > "$2"\n'
                                'while [ "$1" != --times ]; do shift; done\n'
                                f"echo '{json.dumps(TIMES)}' > \"$2\"")  # fmt: skip

    def config(self, text):
        (self.folder / "config.yaml").write_text(text)

    def program(self, name, text):
        file = self.folder / name
        file.write_text(f"#!/bin/sh\n{text}\n")
        file.chmod(0o755)

    def compare(self, *words, kitti="missing"):
        """Returns exit code, standard output and error."""
        out, err = io.StringIO(), io.StringIO()
        config = str(self.folder / "config.yaml")
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main(["--scenes", str(self.folder), "--config", config, "--kitti-config", config,
                         "--kitti", str(self.folder / kitti), "--programs", str(self.folder),
                         "--out", str(self.out), *words])  # fmt: skip
        return code, out.getvalue(), err.getvalue()

    def words_of(self, *position):
        return self.out.joinpath(*position).read_text().split()

    def test_each_set_at_each_level(self):
        code, out, _ = self.compare("--seeds", "1", "2")
        self.assertEqual(code, 0)
        self.assertEqual([row[:6] for row in rows(out)[:24]], [
            [f"data_set_{i}", level, thesis, "4", "of", "30"]
            for i, missed, fused in ((1, "10", "7"), (2, "12", "8"), (3, "7", "4"))
            for level, thesis in (
                ("none", missed), ("low", "-"), ("object", fused), ("track", "-"),
                ("none+borders", "-"), ("low+borders", "-"), ("object+borders", "-"),
                ("recommended", "-"))
        ])  # fmt: skip
        for seed in ("1", "2"):
            words = self.words_of(f"data_set_1_{seed}", "drive.bag")
            self.assertLessEqual({"stereo/enabled=true", f"seed={seed}"}, set(words))
        for level in ("none", "low", "object", "track", "low+borders"):
            words = self.words_of("data_set_1_1", level, "result.bag")
            for name, word in (("low", "--low-level-fusion"), ("object", "--object-fusion"),
                               ("track", "--track-fusion"),
                               ("borders", "--road-border")):  # fmt: skip
                self.assertEqual(word in words, name in level, level)
        words = self.words_of("data_set_1_1", "recommended", "result.bag")
        self.assertEqual(words[words.index("--fusion") + 1], "recommended")
        runs = json.loads((self.out / "comparison.json").read_text())["runs"]
        self.assertEqual(len(runs), 48)
        self.assertEqual([runs[8][key] for key in ("drive", "run", "level")],
                         ["data_set_1", "data_set_1_2", "none"])  # fmt: skip
        self.assertEqual(runs[0]["figures"]["missed_objects_any_sensor"], 6)
        self.assertEqual(runs[0]["figures"]["false_tracks"], 15)
        self.assertEqual(runs[0]["figures"]["false_tracks_in_view"], 2)
        picture = (self.out / "comparison.svg").read_text()
        for text in ("data_set_3", "object+borders", "false tracks in the camera"):
            self.assertIn(text, picture)

    def test_chosen_sets_and_levels(self):
        out = self.compare("--sets", "2", "--seeds", "7", "--levels", "low+object")[1]
        self.assertEqual(rows(out)[0][:3], ["data_set_2", "low+object", "-"])
        self.assertEqual([path.name for path in self.out.glob("data_set_*")], ["data_set_2_7"])
        words = self.words_of("data_set_2_7", "low+object", "result.bag")
        self.assertLessEqual({"--low-level-fusion", "--object-fusion"}, set(words))

    def test_labeled_drive(self):
        (self.folder / "drive_0005").mkdir()
        code, out, _ = self.compare("--sets", "--levels", "none", kitti="drive_0005")
        self.assertEqual(code, 0)
        self.assertEqual(rows(out)[0][:7], ["drive_0005", "none", "-", "6", "of", "33", "-"])
        self.assertIn("Moving objects of drive_0005", out)
        self.assertIn("--images", self.words_of("drive_0005", "drive.bag"))

    def test_drive_that_is_not_there_is_reported(self):
        self.assertIn("missing: not found, so there is no KITTI", self.compare("--sets", "1")[1])

    def test_failed_run_is_reported_and_the_others_continue(self):
        self.run_bag('case "$*" in *--object*) echo "no list" >&2; exit 1;; esac')
        code, out, _ = self.compare(
            "--sets", "1", "--seeds", "3", "--levels", "none", "low", "object")  # fmt: skip
        self.assertEqual(code, 1)
        self.assertIn("data_set_1_3, object: no list", out)
        self.assertEqual([row[3] for row in rows(out)[:3]], ["4", "4", "-"])
        runs = json.loads((self.out / "comparison.json").read_text())["runs"]
        self.assertIsNone(runs[2]["figures"])

    def test_program_that_is_ended_is_reported(self):
        self.run_bag("kill -SEGV $$")
        out = self.compare("--sets", "1", "--seeds", "3", "--levels", "none")[1]
        self.assertIn("data_set_1_3, none: run_bag: ended by signal 11 (Segmentation fault)", out)

    def test_failed_recording_is_reported_once(self):
        self.program("simulate", 'echo "no road" >&2; exit 1')
        code, out, _ = self.compare("--sets", "1", "--seeds", "3")
        self.assertEqual(code, 1)
        self.assertEqual(out.count("data_set_1_3: no road"), 1)

    def test_recordings_may_be_used_again(self):
        self.compare("--sets", "1", "--seeds", "3", "--levels", "none")
        (self.out / "data_set_1_3" / "drive.bag").write_text("mine")
        self.compare("--sets", "1", "--seeds", "3", "--levels", "none", "--reuse-drives")
        self.assertEqual(self.words_of("data_set_1_3", "drive.bag"), ["mine"])
        self.compare("--sets", "1", "--seeds", "3", "--levels", "none")
        self.assertNotEqual(self.words_of("data_set_1_3", "drive.bag"), ["mine"])

    def test_missing_file_is_named(self):
        (self.folder / "data_set_3.yaml").unlink()
        code, _, err = self.compare()
        self.assertEqual(code, 1)
        self.assertIn("data_set_3.yaml: no such file", err)

    def test_bad_field_of_view_is_named(self):
        self.config("stereo_camera: {field_of_view: wide}")
        code, _, err = self.compare()
        self.assertEqual(code, 1)
        self.assertIn("stereo_camera/field_of_view is 'wide', expected a number", err)


class CameraViews(unittest.TestCase):
    def test_defaults_as_list_parameters_prints_them(self):
        """doc/parameters.md is what it prints: another test checks that."""
        page = (Path(__file__).parents[2] / "doc" / "parameters.md").read_text(encoding="utf-8")
        view = self.view("", page)
        self.assertEqual(view.range, 36.0)
        self.assertGreater(view.half_angle, 0.3)

    def view(self, config, parameters=PARAMETERS):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "config.yaml"
            file.write_text(config)
            program = Path(folder) / LIST_PARAMETERS
            program.write_text(f"#!/bin/sh\ncat <<'END'\n{parameters}END\n")
            program.chmod(0o755)
            return camera_view(file, Path(folder))

    def test_of_the_sensor_set(self):
        config = "stereo_camera: {effective_range: 20, field_of_view: 1.2}"
        self.assertEqual(self.view(config), CameraView(20.0, 0.6))

    def test_else_of_the_stages_defaults(self):
        for config in ("", "tracker: {effective_range: 9}", "stereo_camera: {}"):
            self.assertEqual(self.view(config), CameraView(36.0, 0.5), config)

    def test_defaults_that_are_not_given_are_named(self):
        with self.assertRaisesRegex(InputError, "effective_range"):
            self.view("", PARAMETERS.replace("36", "''"))

    def test_is_the_region_that_is_scored(self):
        words = within(CameraView(36.0, 0.5), ("truth/visible_to=none", "region/range=500"))
        self.assertEqual(
            words, ("truth/visible_to=none", "region/range=36.0", "region/half_angle=0.5")
        )


if __name__ == "__main__":
    unittest.main()
