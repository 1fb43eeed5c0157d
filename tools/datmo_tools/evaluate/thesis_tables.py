# SPDX-License-Identifier: BSD-3-Clause
"""Formats tables 3.1 to 3.5 of the thesis, with our runs on simulated data sets next to them."""

from typing import NamedTuple

from datmo_tools.text_table import NO_VALUE, aligned

NOTE = """\
The thesis's data sets were driven; ours are simulated streets with as many seconds, moving objects
and intersections. The columns say of which order the counts are, not who is better."""


class Published(NamedTuple):
    """The thesis's figures for one data set."""

    seconds: int
    moving_objects: int
    missed: int  # moving objects without a track, laser alone
    missed_with_fusion: int
    laser_tracks: int
    stereo_tracks: int
    parallel_tracks: int  # seen by both sensors
    false_moving: int  # false moving objects, without road borders
    false_moving_with_borders: int
    intersections: int
    intersections_found: int
    intersections_false: int


PUBLISHED = (
    Published(64, 30, 10, 7, 108, 24, 18, 70, 45, 2, 2, 1),
    Published(150, 21, 12, 8, 147, 38, 27, 103, 80, 1, 1, 1),
    Published(196, 43, 7, 4, 198, 65, 54, 150, 95, 4, 4, 4),
)


class Table(NamedTuple):
    """One table: columns of the thesis, then ours, then ours with road borders."""

    title: str
    thesis: tuple  # (heading, name of the value in Published)
    ours: tuple  # (heading, function of the counts in score_run's section "thesis")
    with_borders: tuple = ()  # the same


def _count(field):
    return lambda counts: counts[field]


def _of_both(field):
    """Returns tracks of two sensors; no value with only one sensor."""
    return lambda counts: counts[field] if counts["confirmed_tracks"] else None


def _mean(field):
    return lambda counts: None if counts[field] is None else f"{counts[field]:.1f}"


TABLES = (
    Table("Table 3.1: data sets",
          (("time, s", "seconds"), ("moving objects", "moving_objects")),
          (("moving objects", _count("moving_objects")),)),
    Table("Table 3.2: moving objects that were missed",
          (("laser", "missed"), ("fusion", "missed_with_fusion")),
          (("missed", _count("missed_objects")),)),
    Table("Table 3.3: tracks",
          (("laser", "laser_tracks"), ("stereo", "stereo_tracks"), ("of both", "parallel_tracks")),
          (("all", _count("tracks")), ("of them false", _count("false_tracks")),
           ("of both", _of_both("confirmed_tracks")),
           ("of both, true", _of_both("confirmed_true_tracks")))),
    Table("Table 3.4: false moving objects, before tracking",
          (("without borders", "false_moving"), ("with borders", "false_moving_with_borders")),
          (("without borders", _count("false_moving_objects_episodes")),
           ("in a scan", _mean("false_moving_objects_frames"))),
          (("with borders", _count("false_moving_objects_episodes")),
           ("in a scan", _mean("false_moving_objects_frames")))),
    Table("Table 3.5: intersections",
          (("there", "intersections"), ("found", "intersections_found"),
           ("false", "intersections_false")),
          (("there", _count("intersections")),),
          (("found", _count("intersections_found")), ("false", _count("intersections_false")))),
)  # fmt: skip


def thesis_tables(reports, with_borders=(None,) * len(PUBLISHED)):
    """Returns the text of all tables.

    reports: of score_run (dicts), one for each data set in turn; None if a run failed;
    with_borders: the same of runs with road borders; None if there was none.
    """
    return "\n\n".join([NOTE, *(_text(table, reports, with_borders) for table in TABLES)])


def _text(table, reports, with_borders):
    ours = table.ours + table.with_borders
    sources = ["", *("thesis" for _ in table.thesis), *("ours" for _ in ours)]
    rows = [sources, ["data set", *(heading for heading, _ in table.thesis + ours)]]
    for number, runs in enumerate(zip(PUBLISHED, reports, with_borders), start=1):
        published, report, bordered = runs
        rows.append([str(number), *(str(getattr(published, field)) for _, field in table.thesis),
                     *(_our_cell(value, report) for _, value in table.ours),
                     *(_our_cell(value, bordered) for _, value in table.with_borders)])  # fmt: skip
    return f"{table.title}\n{aligned(rows)}"


def _our_cell(value, report):
    count = None if report is None else value(report["thesis"])
    return NO_VALUE if count is None else str(count)
