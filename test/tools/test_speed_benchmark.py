#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figures of speed_benchmark from small samples that are worked out by hand. Nothing is timed."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

from datmo_tools.experiments import (
    process_usage,
    speed_benchmark,
    speed_live,
    speed_micro,
    speed_report,
)
from datmo_tools.experiments.speed_context import cmake_cache, devel_space
from datmo_tools.errors import InputError
from datmo_tools.experiments.process_usage import ProcessUsage


class OfAProcess(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.proc = Path(folder.name)

    def put(self, pid, stat, status):
        (self.proc / str(pid)).mkdir()
        (self.proc / str(pid) / "stat").write_text(stat)
        (self.proc / str(pid) / "status").write_text(status)

    def test_read_by_the_layout_of_proc(self):
        ticks = process_usage.TICKS
        self.put(7, f"7 (a (b) c) S 1 1 1 0 -1 0 0 0 0 0 {3 * ticks} {2 * ticks} 0 0 20 0\n",
                 "Name:\ta\nVmHWM:\t  3072 kB\nVmRSS:\t  2048 kB\nThreads:\t4\n")  # fmt: skip
        self.assertEqual(
            process_usage.read(7, time=1.5, proc=self.proc), ProcessUsage(1.5, 5.0, 2.0, 3.0)
        )

    def test_a_process_that_has_ended_or_is_a_zombie(self):
        self.put(8, "8 (a) Z 1 1 1 0 -1 0 0 0 0 0 1 1 0 0 20 0\n", "Name:\ta\n")
        self.assertIsNone(process_usage.read(8, 0.0, self.proc))
        self.assertIsNone(process_usage.read(9, 0.0, self.proc))

    def test_share_and_growth_between_two_times(self):
        samples = [
            ProcessUsage(0.0, 9.0, 10.0, 10.0),  # before: loading
            ProcessUsage(1.0, 10.0, 20.0, 20.0),
            ProcessUsage(2.0, 10.2, 30.0, 30.0),  # the first quarter is over
            ProcessUsage(5.0, 11.0, 31.5, 33.0),
            ProcessUsage(6.0, 19.0, 99.0, 99.0),  # after
        ]
        use = process_usage.summarize(samples, 1.0, 5.0)
        self.assertAlmostEqual(use["cpu_share"], 0.25)
        self.assertEqual(use["memory_peak_mib"], 33.0)
        self.assertEqual(use["memory_growth_mib"], 1.5)


class Live(unittest.TestCase):
    def test_figures_of_a_run(self):
        samples = [ProcessUsage(0.0, 0.0, 1.0, 1.0), ProcessUsage(9.0, 9.0, 1.0, 1.0)]
        times = {
            "first_scan": 0.0,
            "last_scan": 9.0,
            "latency": [0.003, 0.001, 0.002],
            "unanswered": 1,
            "stages": {"tracker": [0.0005]},
        }
        figures = speed_live.summarize(times, samples)
        self.assertEqual((figures["scans"], figures["unanswered"]), (4, 1))
        self.assertAlmostEqual(figures["latency_ms"]["median"], 2.0)
        self.assertAlmostEqual(figures["latency_ms"]["percentile_99"], 2.98)
        self.assertAlmostEqual(figures["latency_ms"]["worst"], 3.0)
        self.assertAlmostEqual(figures["processing_ms"]["tracker"]["median"], 0.5)
        self.assertEqual(figures["cpu_share"], 1.0)


def micro_run(name, time, **more):
    return {"name": name, "run_name": name, "run_type": "iteration", "repetitions": 1,
            "cpu_time": time, "time_unit": "us", **more}  # fmt: skip


class Micro(unittest.TestCase):
    def test_one_repetition_counts_itself(self):
        report = {"benchmarks": [micro_run("step", 3.0, time_unit="ms", per_pose=2e-6)]}
        self.assertEqual(
            speed_micro.summarize(report), {"step": {"cpu_us": 3000.0, "per_pose_us": 2.0}}
        )

    def test_quantiles_that_a_benchmark_counts_are_kept(self):
        report = {"benchmarks": [micro_run("risk", 3.0, median=2e-6, percentile_99=9e-6)]}
        self.assertEqual(speed_micro.summarize(report),
                         {"risk": {"cpu_us": 3.0, "median_us": 2.0, "percentile_99_us": 9.0}})  # fmt: skip

    def test_of_several_the_median_counts(self):
        several = {"repetitions": 3}
        aggregate = {**several, "run_type": "aggregate"}
        report = {
            "benchmarks": [
                micro_run("step", 1.0, **several),
                micro_run("step", 5.0, aggregate_name="mean", **aggregate),
                micro_run("step", 4.0, aggregate_name="median", **aggregate),
            ]
        }
        self.assertEqual(speed_micro.summarize(report), {"step": {"cpu_us": 4.0}})

    def test_a_fit(self):
        fit = {"run_name": "grow", "run_type": "aggregate", "repetitions": 5}
        report = {
            "benchmarks": [
                {**fit, "name": "grow_BigO", "aggregate_name": "BigO", "cpu_coefficient": 2000.0,
                 "time_unit": "ns"},
                {**fit, "name": "grow_RMS", "aggregate_name": "RMS", "rms": 0.02},
            ]
        }  # fmt: skip
        self.assertEqual(
            speed_micro.summarize(report), {"grow/fit": {"cpu_us": 2.0, "error": 0.02}}
        )

    def test_a_benchmark_that_failed_is_named(self):
        report = {"benchmarks": [micro_run("step", 0, error_occurred=True, error_message="why")]}
        with self.assertRaisesRegex(InputError, "step: why"):
            speed_micro.summarize(report)


def report_of(micro, commit="a"):
    return {"format": 1, "context": {"commit": commit}, "micro": micro}


class Report(unittest.TestCase):
    def test_median_over_runs(self):
        runs = [{"a": {"b": value}, "c": -value} for value in (1.0, 9.0, 2.0)]
        self.assertEqual(speed_report.medians(runs), {"a": {"b": 2.0}, "c": -2.0})

    def test_comparison(self):
        old = report_of({"step": {"cpu_us": 4.0}, "gone": {"cpu_us": 1.0}, "none": {"cpu_us": 0.0}})
        new = report_of({"step": {"cpu_us": 3.0}, "more": {"cpu_us": 1.0}, "none": {"cpu_us": 2.0}},
                        commit="b")  # fmt: skip
        lines = speed_report.comparison(old, new).splitlines()
        self.assertEqual(lines[0], "commit: a -> b")
        self.assertEqual(lines[2].split(), ["micro/step/cpu_us", "4", "3", "0.75"])
        self.assertEqual(lines[3].split(), ["micro/none/cpu_us", "0", "2", "-"])
        self.assertIn("only in the old one: micro/gone/cpu_us", lines)
        self.assertIn("only in the new one: micro/more/cpu_us", lines)

    def test_ratios_to_the_limit(self):
        report = report_of({"step": {"cpu_us": 8.0}, "limit/step": {"cpu_us": 2.0},
                            "alone": {"cpu_us": 1.0}, "limit/none": {"cpu_us": 1.0}})  # fmt: skip
        self.assertEqual(speed_report.ratios(report), {"step": (8.0, 2.0, 4.0)})
        lines = speed_report.table(report).splitlines()
        self.assertEqual(lines[1].split(), ["step", "8", "2", "4"])
        self.assertIn("micro/alone/cpu_us", lines[-2])

    def test_ratios_are_compared_instead_of_times(self):
        old = report_of({"step": {"cpu_us": 8.0}, "limit/step": {"cpu_us": 2.0},
                         "other": {"cpu_us": 1.0}, "limit/other": {"cpu_us": 1.0}})  # fmt: skip
        half_as_fast = report_of({"step": {"cpu_us": 16.0}, "limit/step": {"cpu_us": 4.0},
                                  "other": {"cpu_us": 4.0}, "limit/other": {"cpu_us": 2.0}})  # fmt: skip
        self.assertEqual(speed_report.slower(old, half_as_fast), ["other"])
        self.assertEqual(speed_report.slower(half_as_fast, old), [])
        lines = speed_report.judgement(old, half_as_fast).splitlines()
        self.assertEqual(lines[1].split(), ["step", "4", "4", "1.00"])
        self.assertEqual(lines[2].split(), ["other", "1", "2", "2.00", "slower"])
        self.assertIn("faster", speed_report.judgement(half_as_fast, old))
        self.assertIn("no hot path", speed_report.judgement(old, report_of({"a": {"cpu_us": 1.0}})))

    def test_nothing_in_common(self):
        with self.assertRaises(InputError):
            speed_report.comparison(report_of({"a": 1.0}), report_of({"b": 1.0}))


class CommandLine(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_tool(self, *words):
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            code = speed_benchmark.main([str(word) for word in words])
        return code, out.getvalue(), errors.getvalue()

    def test_compare_reads_what_is_written(self):
        file = self.folder / "one.json"
        file.write_text(json.dumps(report_of({"step": {"cpu_us": 4.0}})))
        code, out, _ = self.run_tool("--compare", file, file)
        self.assertEqual(code, 0)
        self.assertIn("1.00", out)

    def test_a_regression_is_in_the_exit_code(self):
        files = []
        for time in (4.0, 8.0):
            files.append(self.folder / f"{time}.json")
            micro = {"step": {"cpu_us": time}, "limit/step": {"cpu_us": 1.0}}
            files[-1].write_text(json.dumps(report_of(micro)))
        code, out, _ = self.run_tool("--compare", *files)
        self.assertEqual(code, speed_benchmark.SLOWER)
        self.assertIn("slower", out)
        self.assertEqual(self.run_tool("--compare", *reversed(files))[0], 0)

    def test_two_files_are_compared_at_the_most(self):
        with self.assertRaises(SystemExit) as ended:
            self.run_tool("--compare", "a", "b", "c")
        self.assertEqual(ended.exception.code, 2)

    def test_files_that_are_not_benchmarks_are_named(self):
        for text in ("", "[]", '{"format": 0}'):
            file = self.folder / "bad.json"
            file.write_text(text)
            code, _, errors = self.run_tool("--compare", file, file)
            self.assertEqual(code, 1)
            self.assertIn("bad.json", errors)

    def test_an_unknown_part_is_named(self):
        code, _, errors = self.run_tool("mirco", "--out", self.folder / "x.json")
        self.assertEqual(code, 1)
        self.assertIn("mirco", errors)

    def test_a_folder_without_a_build_is_named(self):
        output = self.folder / "x.json"
        code, _, errors = self.run_tool("micro", "--build", self.folder, "--out", output)
        self.assertEqual(code, 1)
        self.assertIn(f"{self.folder / 'CMakeCache.txt'}: expected a build folder", errors)
        self.assertFalse(output.exists())

    def test_no_runs_are_refused(self):
        for runs in ("0", "-1", "1.5", "x"):
            with self.assertRaises(SystemExit) as ended:
                self.run_tool("--runs", runs)
            self.assertEqual(ended.exception.code, 2)


class CmakeCache(unittest.TestCase):
    def test_devel_space_is_where_it_was_configured(self):
        with tempfile.TemporaryDirectory() as name:
            cache = Path(name) / "CMakeCache.txt"
            cache.write_text("")
            self.assertEqual(devel_space(Path(name)), Path(name) / "devel")
            cache.write_text("CATKIN_DEVEL_PREFIX:PATH=/a/devel\n")
            self.assertEqual(devel_space(Path(name)), Path("/a/devel"))

    def test_entries(self):
        text = "// a comment = b\n# c=d\nCXX:FILEPATH=/usr/bin/c++\nFLAGS:STRING=-O2 -DA=1\n\n"
        self.assertEqual(cmake_cache(text), {"CXX": "/usr/bin/c++", "FLAGS": "-O2 -DA=1"})


if __name__ == "__main__":
    unittest.main()
