#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Output of evaluate for known runs: figures, table, page and plots."""

import math
import re
import unittest
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser

from datmo_tools.evaluate import object_plots
from datmo_tools.evaluate import plots
from datmo_tools.evaluate.metrics import (
    Metric,
    best_runs,
    extent,
    higher,
    lower,
    near,
    short_names,
)
from datmo_tools.evaluate.report import as_page, as_text
from datmo_tools.evaluate.run_report import sections
from datmo_tools.evaluate.metric_groups import OBJECT_METRICS, metric_groups
from datmo_tools.evaluate.plot_style import plain
from evaluation_sample import sample_run


def table(runs):
    return as_text(sections(runs))


def page(runs):
    return as_page("Evaluation", sections(runs))


def find_line(text, begin):
    """Returns the words of the first line of `text` that begins like this."""
    return next(line.split() for line in text.splitlines() if line.strip().startswith(begin))


class Metrics(unittest.TestCase):
    def test_value_in_the_shown_unit(self):
        share = Metric("", "a.b", "%", 100.0, 1)
        self.assertEqual(share.text(share.value({"a": {"b": 0.1234}})), "12.3")
        third = Metric("", "a.1.b", "m", 1.0, 2)
        self.assertEqual(third.value({"a": [{"b": 5.0}, {"b": 7.0}]}), 7.0)

    def test_missing_values(self):
        metric = Metric("", "a.1.b")
        for run in ({}, {"a": None}, {"a": []}, {"a": [{}, {}]}, {"a": [{}, {"b": None}]}):
            self.assertIsNone(metric.value(run))
        self.assertEqual(metric.text(None), "-")
        self.assertEqual(metric.text(math.nan), "-")

    def test_best(self):
        runs = [{"a": value} for value in (1.0, 3.0, 2.0, None, 3.001)]
        self.assertEqual(best_runs(Metric("", "a", cost=lower), runs), {0})
        self.assertEqual(best_runs(Metric("", "a", cost=higher), runs), {1, 4})  # both shown as 3
        self.assertEqual(best_runs(Metric("", "a", cost=near(2.0)), runs), {2})
        self.assertEqual(best_runs(Metric("", "a"), runs), set())

    def test_nothing_to_choose(self):
        metric = Metric("", "a", cost=lower)
        self.assertEqual(best_runs(metric, [{"a": 1.0}]), set())
        self.assertEqual(best_runs(metric, [{"a": 1.0}, {"a": 1.001}]), set())
        self.assertEqual(best_runs(metric, [{"a": 1.0}, {"a": None}]), set())

    def test_near_is_how_many_times_too_much_or_too_little(self):
        cost = near(2.0)
        self.assertAlmostEqual(cost(1.0), cost(4.0))
        self.assertLess(cost(3.0), cost(1.0))
        self.assertEqual(cost(0.0), math.inf)

    def test_all_figures_are_in_the_sample(self):
        """A misspelled path would always show "-": what the sample leaves open is open on
        purpose."""
        run = sample_run()
        empty = [
            m.path
            for group in metric_groups([run])
            for m in group.metrics
            if m.value(run) is None
        ]
        self.assertEqual(
            empty,
            ["thesis.intersections", "thesis.intersections_found", "thesis.intersections_false"],
        )
        for metric in OBJECT_METRICS:
            self.assertIsNotNone(metric.value(run["objects"][0]), metric.path)

    def test_attainable_delays_are_shown_where_there_are_some(self):
        def titles(run):
            return [group.title for group in metric_groups([run])]

        self.assertIn("Delay compared with the attainable minimum", titles(sample_run()))
        without = {**sample_run(), "attainable": None}
        self.assertNotIn("Delay compared with the attainable minimum", titles(without))

    def test_names_of_runs(self):
        self.assertEqual(short_names(["x/a.bag", "y/b.bag"]), ["a", "b"])
        self.assertEqual(short_names(["r/x/o.bag", "r/y/o.bag"]), ["x/o", "y/o"])
        self.assertEqual(short_names(["same.bag", "same.bag"]), ["same", "same"])
        self.assertEqual(short_names(["o.bag", "x/o.bag"]), ["o", "x/o"])

    def test_extent(self):
        self.assertEqual(extent(sample_run()), "0.6 s, 10 frames, 3 tracks")
        self.assertIn("7 messages", extent(sample_run(messages_left_out=7)))


class Table(unittest.TestCase):
    def test_figures_with_their_units(self):
        text = table([sample_run()])
        self.assertEqual(find_line(text, "MOTP"), "MOTP, distance of matches m 0.25".split())
        self.assertEqual(find_line(text, "heading"), ["heading", "deg", "5.7"])  # 0.1 rad
        self.assertEqual(find_line(text, "intersections"), ["intersections", "(3.5)", "-"])
        self.assertNotIn("*", text)

    def test_objects(self):
        text = table([sample_run()])
        self.assertEqual(
            find_line(text, "1   "), "1 Car vehicle 0.0 0.5 10 8 80.0 0.12 0.06 1.5 0.25 0.50 5.7 71 81".split()
        )
        self.assertEqual(find_line(text, "2   ")[-1], "MISSED")

    def test_objects_of_several_runs(self):
        other = sample_run("other.bag", objects=1)  # misses the only one that it shares
        text = table([sample_run(), other])
        of_other = text[text.index("Objects: other") :]
        self.assertEqual(find_line(text, "1   ")[-2:], ["71", "81"])
        self.assertEqual(find_line(of_other, "1   ")[-1], "MISSED")

    def test_objects_that_never_move(self):
        line = next(x for x in table([sample_run()]).splitlines() if "never move" in x)
        self.assertEqual(line, "drive: of 1 objects that never move 1 had a track at times")

    def test_times_and_latencies_where_they_are_known(self):
        text = table([sample_run()])
        self.assertEqual(find_line(text, "tracker since the scan, 99 %")[-1], "2.20")
        self.assertNotIn("grid_slam since", text)

    def test_lines_are_as_wide_as_a_wide_terminal(self):
        self.assertLessEqual(max(map(len, table([sample_run()]).splitlines())), 130)


class Structure(HTMLParser):
    """Finds elements that are not closed, and addresses that a browser would fetch."""

    VOID = {"meta", "br", "use"}

    def __init__(self):
        super().__init__()
        self.open, self.fetched, self.tags = [], [], set()

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        if tag not in self.VOID:
            self.open.append(tag)
        self.fetched += [
            value
            for name, value in attrs
            if name in ("src", "href", "xlink:href") and not value.startswith("#")
        ]

    def handle_startendtag(self, tag, attrs):
        self.tags.add(tag)

    def handle_endtag(self, tag):
        if tag not in self.VOID:
            assert self.open.pop() == tag, tag


class Page(unittest.TestCase):
    def test_is_whole_and_fetches_nothing(self):
        for runs in ([sample_run()], [sample_run("a.bag"), sample_run("b.bag")]):
            structure, text = Structure(), page(runs)
            structure.feed(text)
            self.assertTrue(text.startswith("<!DOCTYPE html>"))
            self.assertEqual(structure.open, [])
            self.assertEqual(structure.fetched, [])
            self.assertFalse(structure.tags & {"script", "link", "img", "iframe"})
            self.assertIn("svg", structure.tags)

    def test_no_group_has_a_number_that_another_plot_gives_too(self):
        ids = re.findall(r' id="([^"]+)"', page([sample_run()]))
        self.assertTrue(ids)
        self.assertFalse([name for name in ids if re.match(r"[a-z]+_\d+$", name)])

    def test_text_of_others_is_text(self):
        evil = "<script>alert('&')</script> $x$ _y"
        text = page([sample_run(f"{evil}.bag", label=evil)])
        self.assertNotIn("<script", text)
        self.assertIn("&lt;script&gt;alert(", text)

    def test_figures_are_there(self):
        text = re.sub(r"<[^>]+>", " ", page([sample_run()]))
        for expected in (
            r"MOTP, distance of matches\s+m\s+0\.25",
            r"1 of 2\s+objects found",
            r"gate\s+2\.0",
            r"Car\s+vehicle\s+0\.0\s+0\.5\s+10\s+8",
        ):
            self.assertRegex(text, expected)

    def test_best_is_marked(self):
        runs = [sample_run("a.bag"), sample_run("b.bag", clear_mot={"mota": 0.6})]
        self.assertIn('<td>40.0</td><td class="best">60.0*</td>', page(runs))

    def test_a_run_with_few_figures(self):
        run = sample_run(objects=0, frames=1, pose=None, timing=None)
        for section in ("hota", "gospa", "errors", "clear_mot", "identity"):
            run[section] = {key: None for key in run[section]}
        run["hota"].update(alphas=[0.5], hota_alpha=[])  # as score_run writes it
        for state in run["consistency"].values():
            state.update(mean_nees=None, lower=None, upper=None, inside_share=None)
        run["series"]["pose_error_m"] = [None]
        self.assertIn("</html>", page([run, run]))
        self.assertIn("MOTA", table([run]))


class Plots(unittest.TestCase):
    def texts(self, svg):
        """Returns the texts of an SVG element; it is well-formed."""
        svg = svg.replace("xlink:href", "href")
        return [
            element.text
            for element in ElementTree.fromstring(svg).iter()
            if element.tag.endswith("text")
        ]

    def test_axes_have_units(self):
        runs, names = [sample_run()], ["a"]
        for svg, expected in (
            (plots.errors_over_time(runs, names), ["m", "m/s", "time (s)"]),
            (plots.counts_over_time(runs[0]), ["tracked", "missed", "false tracks", "time (s)"]),
            (plots.hota_over_alpha(runs, names), ["HOTA (%)", "a: mean 35.0 %"]),
            (plots.consistency(runs, names), ["position", "velocity", "mean NEES"]),
            (plots.pose_over_time(runs, names), ["m", "time (s)"]),
            (plots.stage_times(runs, names), ["grid_slam", "time (ms)"]),
            (object_plots.timeline(runs[0]), ["Car 1", "Car 2", "71", "81", "time (s)"]),
            (object_plots.birds_eye(runs[0]), ["x (m)", "y (m)", "track", "vehicle, true"]),
        ):
            self.assertEqual(set(expected) - set(self.texts(svg)), set())

    def test_runs_have_a_legend_where_there_are_several(self):
        runs = [sample_run(), sample_run()]
        self.assertIn("second", self.texts(plots.errors_over_time(runs, ["first", "second"])))
        self.assertNotIn("first", self.texts(plots.errors_over_time(runs[:1], ["first"])))

    def test_a_track_on_nothing_is_shown_as_such(self):
        run = sample_run()  # its track 99 is on no object
        self.assertIn("track on no true object", self.texts(object_plots.birds_eye(run)))
        run["series"]["track_paths"] = run["series"]["track_paths"][:2]
        self.assertNotIn("track on no true object", self.texts(object_plots.birds_eye(run)))

    def test_plain_text_is_no_formula(self):
        self.assertEqual(plain("a$b$"), r"a\$b\$")
        self.assertEqual(plain("_hidden"), " _hidden")


class Spans(unittest.TestCase):
    def assert_spans(self, keys, expected, times=None):
        times = times or list(range(len(keys)))
        self.assertEqual(object_plots.spans(times, keys, 1), expected)

    def test_one_key_is_one_span_and_lasts_to_the_end_of_its_last_sample(self):
        self.assert_spans([7, 7, 7], [(0, 3, 7)])

    def test_another_key_and_none_end_a_span(self):
        self.assert_spans([7, 7, 8, None, 8, None], [(0, 2, 7), (2, 3, 8), (4, 5, 8)])

    def test_a_pause_ends_a_span_and_jitter_does_not(self):
        self.assert_spans([7, 7, 7], [(0, 2.4, 7), (3.4, 4.4, 7)], [0, 1.4, 3.4])

    def test_nothing(self):
        self.assert_spans([], [])
        self.assert_spans([None], [])


if __name__ == "__main__":
    unittest.main()
