# SPDX-License-Identifier: BSD-3-Clause
"""What the stack does when its inputs fail: the command line, the runs and the report."""

import json
import tempfile
from pathlib import Path

import numpy as np
from tqdm import tqdm

from datmo_tools import command_line, programs, transforms
from datmo_tools.bag_file import whole_bag
from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.line_faults import INPUTS, KEPT, Message, faults, faulty
from datmo_tools.pose_path import read_path
from datmo_tools.programs import StepFailed
from datmo_tools.stamps import NANOSECONDS
from datmo_tools.text_table import NO_VALUE
from datmo_tools.whole_files import write_whole

DESCRIPTION = """\
Plays a drive with truth through the stack with one fault of a sensor after the other, and writes what
each of them did to poses and tracks, beside what mutated messages did to the stages, as a page and
as JSON."""

PROGRAMS = ("run_bag", "score_run")
TRACK_FIGURES = ("mota", "misses", "false_positives", "id_switches")
TRUTH = "/ground_truth/pose"
# A pose is right again when its error is that of the clean drive again, by this much (m).
RECOVERED = 0.3


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run("campaign", lambda: _campaign(values), "report")


def pose_errors(computed, recorded):
    """Stamps (s, n) of the poses in a bag (Path), and how far each is off (m, n), from the first on."""
    truth, path = read_path(recorded, TRUTH), read_path(computed, "/pose")
    stamps = [stamp for stamp in path.stamps if truth.stamps[0] <= stamp <= truth.stamps[-1]]
    start = stamps[0]
    errors = []
    for stamp in stamps:
        motion = transforms.relative(truth.at(start), truth.at(stamp))
        expected = np.asarray(transforms.compose(path.at(start), motion))
        errors.append(float(np.hypot(*(np.asarray(path.at(stamp)) - expected)[:2])))
    return np.asarray(stamps) / NANOSECONDS, np.asarray(errors)


def effect(stamps, errors, clean, begin, end):
    """What a fault from `begin` to `end` (s) did to the poses (dict).

    clean: stamps (s) and errors (m) of the drive without it.
    """
    added = errors - np.interp(stamps, *clean)
    after = stamps >= begin
    wrong = stamps[after & (added > RECOVERED)]
    return {
        "poses": int(len(stamps)),
        "largest_error_m": float(errors[after].max()) if after.any() else None,
        "final_error_m": float(errors[-1]),
        "recovered_s": max(0.0, float(wrong[-1]) - end) if len(wrong) else 0.0,
        "recovered": not len(wrong) or bool(wrong[-1] < stamps[-1]),
    }


def _campaign(values):
    for file in (values.drive, values.config):
        if not file.is_file():
            raise InputError(f"{file}: no such file, expected a bag and a yaml file")
    programs.check(values.programs, PROGRAMS)
    messages = _messages(values.drive)
    begin = messages[0].recorded + values.begin
    runs, clean = [], None
    for fault in tqdm(_chosen(values.faults), "faults"):
        run, path = _run(values, messages, fault, begin, clean)
        clean = clean or path
        runs.append(run)
    mutated = json.loads(values.mutated.read_text(encoding="utf-8")) if values.mutated else None
    report = {"drive": values.drive.name, "begin_s": values.begin, "runs": runs, "mutated": mutated}
    write_whole(values.page.parent, {values.page.name: page(report)})
    if values.out is not None:
        write_whole(values.out.parent, {values.out.name: json.dumps(report, indent=1) + "\n"})


def _chosen(parts):
    """The faults whose name has one of the parts in it; the first one, which is none, in any case."""
    every = faults()
    return [fault for fault in every
            if fault is every[0] or not parts or any(part in fault.name for part in parts)]  # fmt: skip


def _messages(drive):
    topics = [*KEPT, *(topic for topics in INPUTS.values() for topic in topics)]
    with opened(drive) as bag:
        return [Message(topic, content, stamp.to_sec())
                for topic, content, stamp in bag.read_messages(topics)]  # fmt: skip


def _run(values, messages, fault, begin, clean):
    """Result (dict) of one fault, and its stamps and errors."""
    with tempfile.TemporaryDirectory(prefix="campaign_") as name:
        folder = Path(name)
        drive = folder / "drive.bag"
        with whole_bag(drive, "campaign") as out:
            for message in faulty(messages, fault, begin):
                write = out.write_latched if message.topic == "/tf_static" else out.write
                write(message.topic, round(message.recorded * NANOSECONDS), message.content)
        computed = folder / "result.bag"
        try:
            programs.call(values.programs / "run_bag", drive, computed, "--config", values.config,
                          "--with-truth", "--quiet")  # fmt: skip
        except StepFailed as error:
            return {"fault": fault.name, "error": str(error)}, None
        path = pose_errors(computed, drive)
        tracks = _tracks(computed, values.programs, folder)
    poses = effect(*path, clean or path, begin, begin + fault.seconds)
    return {"fault": fault.name, "error": None, "pose": poses, "tracks": tracks}, path


def _tracks(computed, folder_of_programs, folder):
    """Figures of the tracks in a bag (Path); None of each where time went back, which has no score."""
    try:
        score = simulated_run.score(computed, folder_of_programs, (), folder / "score.json")
    except StepFailed:
        return dict.fromkeys(TRACK_FIGURES)
    return {key: score["clear_mot"][key] for key in TRACK_FIGURES}


def page(report):
    """The report as Markdown."""
    lines = [
        "# Reliability",
        "",
        "Written by `scripts/campaign`.",
        "",
        "## Faults on line",
        "",
        f"The drive `{report['drive']}` through `run_bag` with one fault from {report['begin_s']:g} s on. Error: of the",
        "position since the first pose. Recovered: seconds after the fault's end until the position is as right as",
        f"without it, within {RECOVERED:g} m; `never`: not before the drive's end (a clock that jumps back makes a",
        "new map, whose origin is elsewhere). Tracks whose time went back have no score. "
        f"{len(report['runs']) - 1} of the campaign's {len(faults()) - 1} faults.",
        "",
        "| fault | poses | largest error [m] | at the end [m] | recovered [s] | MOTA | misses | false positives | id switches |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    lines += [_row(run) for run in report["runs"]]
    return "\n".join(lines + _mutated_lines(report["mutated"])) + "\n"


def _row(run):
    if run["error"] is not None:
        return f"| {run['fault']} | {run['error']} | | | | | | | |"
    pose, tracks = run["pose"], run["tracks"]
    recovered = f"{pose['recovered_s']:.1f}" if pose["recovered"] else "never"
    cells = [run["fault"], str(pose["poses"]), f"{pose['largest_error_m']:.2f}",
             f"{pose['final_error_m']:.2f}", recovered, _cell(tracks["mota"]),
             *(_cell(tracks[key]) for key in TRACK_FIGURES[1:])]  # fmt: skip
    return f"| {' | '.join(cells)} |"


def _cell(value):
    if value is None:
        return NO_VALUE
    return f"{value:.3f}" if isinstance(value, float) else str(value)


def _mutated_lines(mutated):
    if mutated is None:
        return []
    refused = sorted(mutated["refused"].items(), key=lambda item: (-item[1], item[0]))
    return [
        "",
        "## Mutated messages",
        "",
        f"{mutated['drives']} drives with seeds from {mutated['first_seed']} on, {mutated['messages']} messages as they should be and",
        f"{mutated['mutated']} with one to three fields spoiled (NaN, infinity, bounds of the type, other lengths, names and",
        "stamps), at the doors of the stages, those between them, images and `stereo_alignment` included. Each drive ends",
        "with 3 s without mutations, in which tracks have to come again.",
        "",
        f"- found: {len(mutated['faults'])}" + "".join(f"\n  - {fault}" for fault in mutated["faults"]),
        f"- slowest message with all that follows from it: {mutated['slowest_s']:.2f} s ({mutated['slowest_on']})",
        f"- peak of memory: {mutated['peak_memory_mib']:.0f} MiB",
        "- refused or warned of, by reason: "
        + ", ".join(f"{reason} {count}" for reason, count in refused),
    ]


def _parser():
    parser = command_line.new_parser("campaign", DESCRIPTION)
    add = parser.add_argument
    add("drive", type=Path, metavar="DRIVE.bag", help="with /ground_truth/pose and objects")
    add("--config", required=True, type=Path, metavar="CONFIG.yaml", help="the sensor set")
    add("--programs", required=True, type=Path, metavar="DIR", help="of run_bag and score_run")
    add("--mutated", type=Path, metavar="FILE.json", help="what mutate_messages wrote")
    add("--page", required=True, type=command_line.output_file, metavar="FILE.md", help="the report")
    add("--out", type=command_line.output_file, metavar="FILE.json", help="all runs")
    add("--faults", nargs="+", default=[], metavar="PART", help="those with this in their name (default all)")
    command_line.add_number(parser, "--begin", 8.0, "S", "when the faults begin")
    return parser
