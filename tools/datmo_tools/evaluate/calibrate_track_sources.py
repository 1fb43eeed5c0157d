# SPDX-License-Identifier: BSD-3-Clause
"""evaluate calibrate_track_sources."""

from pathlib import Path

import yaml

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate.arguments import add_region, add_table, add_truths, drives_of, region_of
from datmo_tools.evaluate.plot_files import plotter
from datmo_tools.evaluate.source_tally import CLASSES, OTHER, SourceTally
from datmo_tools.evaluate.track_frames import Scene
from datmo_tools.evaluate.track_lists import TRACKS, read_track_lists
from datmo_tools.evaluate.truth import ANY, NONE
from datmo_tools.text_table import aligned
from datmo_tools.whole_files import write_file

DESCRIPTION = """\
Measures the reliability of the tracks of each source, on drives with truth, and writes it as yaml
for track_fusion:

  detection    of the frames in which a source could lately see a road user that moves, by its
               published view: the share in which it has a track of it, by class and range, as the
               likeliest near / (1 + exp((range - half_range) / 4 m))
  true_share   share of its tracks that are on objects that move at some time, by reported class
  false_agreement_probability
               of the frames of another source's false tracks that it could see: the share in which
               it has a track there, too

Each with one count of either kind added. Values from fewer than --min-frames frames, or fewer than
--min-tracks tracks, are left out: the default remains. Calibrate on other drives than those you
evaluate on."""

PRODUCT = "table"

SOURCES = ("lidar", "stereo")
CLAIMS = (*CLASSES.values(), OTHER)
RANGE = 50.0  # m
GATE = 2.0  # m, as score_run's matching/gate
BIN_WIDTH = 5.0  # m
MIN_FRAMES = 50  # a share is known to 0.07
MIN_TRACKS = 10  # one of 0.9 is known to 0.1


def as_yaml(tallies, min_frames, min_tracks):
    """Returns the section of track_fusion; tallies: dictionary source name -> SourceTally."""

    def known(shares, min_count):
        return {name: round(float(share.value), 3)
                for name, share in shares.items() if share.whole >= min_count}  # fmt: skip

    sections = {}
    for name, tally in tallies.items():
        laws = {each: tally.law(each) for each in CLASSES.values()
                if tally.detection(each).whole >= min_frames}  # fmt: skip
        detection = {each: {"near": round(law.near, 3), "half_range": round(law.half_range, 1)}
                     for each, law in laws.items()}  # fmt: skip
        section = {"detection": detection} if detection else {}
        true_share = known({each: tally.true_share(each) for each in CLAIMS}, min_tracks)
        section.update({"true_share": true_share} if true_share else {})
        section.update(known({"false_agreement_probability": tally.false_agreement}, min_frames))
        sections[name] = section
    return yaml.safe_dump({"track_fusion": {"sources": sections}}, sort_keys=False)


def summary(tallies):
    """Formats the counts as text."""
    rows = [["source", "", "share", "counted"]]
    for name, tally in tallies.items():
        shares = {f"frames: has a {each} that it could see": tally.detection(each)
                  for each in CLASSES.values()}  # fmt: skip
        shares.update({f"tracks: claimed {each}, on what moves": tally.true_share(each)
                       for each in CLAIMS})  # fmt: skip
        shares["frames: track on a false one of another"] = tally.false_agreement
        rows += [[name, what, f"{share.value:.3f}" if share.whole else "-", f"{share.whole:.0f}"]
                 for what, share in shares.items()]  # fmt: skip
    return aligned(rows)


def tally_runs(runs, drives, sources, region, visible_to=ANY, bin_width=BIN_WIDTH):
    """Returns a dictionary source -> SourceTally of runs and drives (Paths). Raises InputError."""
    tallies = {name: SourceTally(bin_width) for name in sources}
    topics = {name: f"{TRACKS}/{name}" for name in sources}
    for run, drive in zip(runs, drives):
        lists = read_track_lists(run, topics.values())
        scene = Scene(run, drive, region, visible_to, GATE)
        frames = {name: scene.frames(topic, lists[topic]) for name, topic in topics.items()}
        for name, tally in tallies.items():
            if not any(frame.views for frame in frames[name]):
                raise InputError(f"{run}: {topics[name]} tells nothing of what its sensor could see, "
                                 "expected views")  # fmt: skip
            tally.add(frames[name])
            for other in sources:
                if other != name:
                    tally.add_agreement(frames[name], frames[other], GATE)
    return tallies


def execute(values):
    """Prints the table and writes it to files. Raises InputError."""
    drives = drives_of(values)
    plot = plotter(values.plot, "source_plot")
    tallies = tally_runs(values.runs, drives, values.sources, region_of(values), values.visible_to)
    print(summary(tallies))
    text = as_yaml(tallies, values.min_frames, values.min_tracks)
    print(text, end="")
    write_file(values.out, text)
    if plot is not None:
        write_file(values.plot, plot(tallies))


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("runs", nargs="+", type=Path, metavar="RUN.bag", help="bags of run_bag --track-fusion")
    add_truths(parser)
    add("--sources", nargs="+", default=list(SOURCES), metavar="NAME",
        help="sources, with tracks on /tracks/NAME (default: lidar stereo)")  # fmt: skip
    add("--visible-to", default=ANY, metavar="SENSOR",
        help="sensor that must see a true object for it to count, "
        f"{ANY}, or {NONE}: not required (default %(default)s)")  # fmt: skip
    add("--min-frames", type=command_line.count, default=MIN_FRAMES, metavar="N",
        help="minimum number of frames for a share to be written (default %(default)s)")  # fmt: skip
    add("--min-tracks", type=command_line.count, default=MIN_TRACKS, metavar="N",
        help="minimum number of tracks for a share to be written (default %(default)s)")  # fmt: skip
    add_table(parser, "track_sources.yaml")
    add("--plot", type=command_line.output_file, metavar="FILE",
        help="picture by range: .svg, .pdf or .png")  # fmt: skip
    add_region(parser, RANGE)
