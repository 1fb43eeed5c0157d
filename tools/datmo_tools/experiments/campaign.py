# SPDX-License-Identifier: BSD-3-Clause
"""Tests what the stack does when its inputs fail: the command line, the runs and the report."""

import json
import tempfile
from pathlib import Path
from typing import NamedTuple

import numpy as np
from tqdm import tqdm

from datmo_tools import command_line, programs, transforms
from datmo_tools.bag_file import whole_bag
from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError
from datmo_tools.experiments import simulated_run
from datmo_tools.experiments.campaign_page import RECOVERED, TRACK_FIGURES, page
from datmo_tools.experiments.fault_bounds import beyond, beyond_silent, read_bounds
from datmo_tools.experiments.kept_ids import gap_effect, kept_ids
from datmo_tools.experiments.line_faults import INPUTS, KEPT, STEREO_INPUTS, Fault, Message, faults, faulty
from datmo_tools.pose_path import read_messages, read_path
from datmo_tools.programs import StepFailed
from datmo_tools.stamps import NANOSECONDS
from datmo_tools.whole_files import write_file

DESCRIPTION = """\
Plays drives with truth through the stack with one sensor fault after another, and writes the effect
of each on poses and tracks, together with the effects of mutated messages, hours of driving, load
and outages on the stages, as a page and as JSON."""
PROGRAMS = ("run_bag", "score_run")
TRUTH = "/ground_truth/pose"
# The drive with a stereo camera: how scanner and camera are fused while the scanner is silent, and when
# (s since its start) it becomes silent.
LEVELS = ("low", "object", "recommended")
SILENT_FROM = (5.0, 7.0, 9.0, 11.0, 13.0)
SILENT = 3.0  # s
SURE = 0.05  # m; lower bound of a pose's sigma, as errors are relative to the first pose


class Played(NamedTuple):
    """A drive that is played through the stack."""

    name: str
    messages: list  # of Message
    options: tuple  # words for run_bag


class Run(NamedTuple):
    """The result of one drive with a fault."""

    fault: Fault
    begin: float  # s
    drive: Path  # bag, with the fault
    computed: Path  # bag
    folder: Path


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run("campaign", lambda: _campaign(values), "report")


def pose_errors(computed, recorded, since=-np.inf, until=np.inf):
    """Returns stamps (s, n) of the poses in a bag (Path) from `since` to `until` (s), and their
    errors (m, n), relative to the first of them. Raises InputError if there is none."""
    truth, path = read_path(recorded, TRUTH), read_path(computed, "/pose")
    stamps = [stamp for stamp in path.stamps
              if max(truth.stamps[0], since * NANOSECONDS) <= stamp <= min(truth.stamps[-1], until * NANOSECONDS)]  # fmt: skip
    if not stamps:
        raise InputError(f"{computed}: no pose on /pose in the time of the truth, expected one or more")
    start = stamps[0]
    errors = []
    for stamp in stamps:
        motion = transforms.relative(truth.at(start), truth.at(stamp))
        expected = np.asarray(transforms.compose(path.at(start), motion))
        errors.append(float(np.hypot(*(np.asarray(path.at(stamp)) - expected)[:2])))
    return np.asarray(stamps) / NANOSECONDS, np.asarray(errors)


def effect(stamps, errors, clean, begin, end):
    """Returns what a fault from `begin` to `end` (s) did to the poses (dict).

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
        "recovered": bool(after.any()) and (not len(wrong) or bool(wrong[-1] < stamps[-1])),
    }


def _campaign(values):
    drives = [path for path in (values.drive, values.stereo) if path is not None]
    for file in (*drives, values.config):
        if not file.is_file():
            raise InputError(f"{file}: no such file, expected a bag and a yaml file")
    programs.check(values.programs, PROGRAMS)
    _check_parts(values.faults, faults() if values.stereo is None else [*faults(), *faults(STEREO_INPUTS)])
    bounds = read_bounds(values.bounds) if values.bounds else None
    played = Played(values.drive.name, _messages(values.drive, INPUTS), ())
    report = {"made": values.made, "begin_s": values.begin, "drives": [_all_faults(values, played, None)], "silent": []}
    if values.stereo is not None:
        messages = _messages(values.stereo, {**INPUTS, **STEREO_INPUTS})
        both = Played(values.stereo.name, messages, ("--fusion", "recommended"))
        report["drives"].append(_all_faults(values, both, STEREO_INPUTS))
        report["silent"] = _silent_scanner(values, both)
    report["beyond"] = _beyond(report, bounds) if bounds else []
    for part in ("mutated", "soak", "load", "outages"):
        file = getattr(values, part)
        report[part] = json.loads(file.read_text(encoding="utf-8")) if file else None
    write_file(values.page, page(report))
    if values.out is not None:
        report["load"] = None  # its samples have a separate file
        command_line.write_json(values.out, report)
    if report["beyond"]:
        raise InputError("faults beyond their bounds:\n  " + "\n  ".join(report["beyond"]))


def _beyond(report, bounds):
    """Returns what of a report (dict) is beyond the bounds, or failed: list of str."""
    of_drives = [line for drive in report["drives"] for line in beyond(drive, bounds)]
    return of_drives + beyond_silent(report["silent"], bounds)


def _all_faults(values, played, inputs):
    """Returns results (dict) of a drive with each fault of its inputs (all, None: also all at
    once)."""
    begin = played.messages[0].recorded + values.begin
    runs, clean = [], None
    for fault in tqdm(_chosen(values.faults, faults(inputs)), played.name):
        run, path = _run(values, played, fault, begin, clean)
        clean = clean or path
        runs.append(run)
    return {"drive": played.name, "options": played.options, "runs": runs, "of": len(faults(inputs)) - 1}


def _chosen(parts, every):
    """Returns the faults with one of the parts in their name, and the first one, which is none."""
    return [fault for fault in every
            if fault is every[0] or not parts or any(part in fault.name for part in parts)]  # fmt: skip


def _check_parts(parts, every):
    """Raises InputError for a part that is in no fault's name."""
    for part in parts:
        if not any(part in fault.name for fault in every):
            names = ", ".join(dict.fromkeys(fault.name for fault in every))
            raise InputError(f"--faults '{part}': in no fault's name, expected a part of one of {names}")


def _messages(drive, inputs):
    topics = [*KEPT, *(topic for topics in inputs.values() for topic in topics)]
    with opened(drive) as bag:
        return [Message(topic, content, stamp.to_sec())
                for topic, content, stamp in bag.read_messages(topics)]  # fmt: skip


def _play(values, played, fault, begin, folder):
    """Returns the Run of a drive with a fault, in a folder (Path). Raises StepFailed."""
    run = Run(fault, begin, folder / "drive.bag", folder / "result.bag", folder)
    with whole_bag(run.drive, "campaign") as out:
        for message in faulty(played.messages, fault, begin):
            write = out.write_latched if message.topic == "/tf_static" else out.write
            write(message.topic, round(message.recorded * NANOSECONDS), message.content)
    programs.call(values.programs / "run_bag", run.drive, run.computed, "--config", values.config,
                  "--with-truth", "--quiet", *played.options)  # fmt: skip
    return run


def _run(values, played, fault, begin, clean):
    """Returns the result (dict) of one fault, and its stamps and errors. If it fails: the error, whether
    the stack refused the drive, and None."""
    with tempfile.TemporaryDirectory(prefix="campaign_") as name:
        try:
            run = _play(values, played, fault, begin, Path(name))
            path = _path(run)
        except (StepFailed, InputError) as error:
            refused = isinstance(error, StepFailed) and error.code > 0
            return {"fault": fault.name, "error": _said(error, name), "refused": refused}, None
        tracks = _tracks(run.computed, values.programs, run.folder)
        poses = {**effect(*path, clean or path, begin, begin + fault.seconds), "largest_sigma_m": _largest_sigma(run),
                 "largest_error_sigmas": _largest_in_sigmas(run, *path)}  # fmt: skip
    return {"fault": fault.name, "error": None, "pose": poses, "tracks": tracks}, path


def _said(error, folder):
    """Returns an error's text without the name of the temporary folder (str)."""
    return str(error).replace(f"{folder}/", "")


def _path(run):
    """Returns stamps and errors as pose_errors does, by the clock before a jump or in the new
    one."""
    jump = run.fault.jump
    if not jump:
        return pose_errors(run.computed, run.drive)
    between = run.begin + 0.5 * jump
    new_map = {"since": between} if jump > 0.0 else {"until": between}
    stamps, errors = pose_errors(run.computed, run.drive, **new_map)
    return stamps - jump, errors


def _largest_sigma(run):
    """Returns the largest sigma (m), in the worst direction, of the poses after the fault began; None:
    no pose."""
    return max((_sigma(message) for message, _ in read_messages(run.computed, "/pose/local")
                if message.header.stamp.to_sec() >= run.begin + min(run.fault.jump, 0.0)), default=None)  # fmt: skip


def _sigma(message):
    """Returns the sigma (m) of a geometry_msgs/PoseWithCovarianceStamped in its worst direction."""
    covariance = np.reshape(message.pose.covariance, (6, 6))[:2, :2]
    return float(np.sqrt(np.linalg.eigvalsh(covariance)[1]))


def _largest_in_sigmas(run, stamps, errors):
    """Returns the largest error after the fault began, in standard deviations of its pose in the
    worst direction, which are at least SURE; stamps and errors: from _path."""
    said = sorted((message.header.stamp.to_sec() - run.fault.jump, _sigma(message))
                  for message, _ in read_messages(run.computed, "/pose"))  # fmt: skip
    after = stamps >= run.begin
    sigmas = np.maximum(np.interp(stamps[after], *np.transpose(said)), SURE)
    return float((errors[after] / sigmas).max()) if after.any() else None


def _silent_scanner(values, played):
    """Returns results (list of dict) of a scanner that is silent for a while, by level and time."""
    results = []
    for level in tqdm(LEVELS, "silent scanner"):
        drive = played._replace(options=("--fusion", level))
        clean, error = _guarded(_clean, values, drive)
        for since in SILENT_FROM:
            result = {}
            if clean is not None:
                result, error = _guarded(_silence, values, drive, clean, since)
            results.append({"level": level, "from_s": since, "error": error, **(result or {})})
    return results


def _guarded(work, *arguments):
    """Returns the result of work(*arguments, temporary folder (Path)) and None, or None and what
    failed (str)."""
    with tempfile.TemporaryDirectory(prefix="campaign_") as name:
        try:
            return work(*arguments, Path(name)), None
        except (StepFailed, InputError) as error:
            return None, _said(error, name)


def _clean(values, drive, folder):
    """Returns stamps and errors of a drive without a fault. Raises StepFailed, InputError."""
    return _path(_play(values, drive, faults(STEREO_INPUTS)[0], drive.messages[0].recorded, folder))


def _silence(values, drive, clean, since, folder):
    """Returns what a scanner that is silent from a time (s since the start) on did to poses and ids
    (dict). Raises StepFailed, InputError."""
    silent = next(each for each in faults(STEREO_INPUTS) if each.name == f"scan silent for {SILENT:g} s")
    begin = drive.messages[0].recorded + since
    run = _play(values, drive, silent, begin, folder)
    distance = read_path(run.drive, TRUTH).length_between(begin * NANOSECONDS, (begin + SILENT) * NANOSECONDS)
    pose = gap_effect(*_path(run), clean, (begin, begin + SILENT), distance)
    return {**pose, **kept_ids(run.computed, run.drive, begin, begin + SILENT)}


def _tracks(computed, folder_of_programs, folder):
    """Returns figures of the tracks in a bag (Path); None for each if time went back: no score."""
    try:
        score = simulated_run.score(computed, folder_of_programs, (), folder / "score.json")
    except StepFailed:
        return dict.fromkeys(TRACK_FIGURES)
    return {key: score["clear_mot"][key] for key in TRACK_FIGURES}


def _parser():
    parser = command_line.new_parser("campaign", DESCRIPTION)
    add = parser.add_argument
    add("drive", type=Path, metavar="DRIVE.bag", help="bag with /ground_truth/pose and objects")
    add("--stereo", type=Path, metavar="DRIVE.bag", help="another, with a stereo camera's points")
    add("--config", required=True, type=Path, metavar="CONFIG.yaml", help="the sensor set")
    add("--programs", required=True, type=Path, metavar="DIR", help="of run_bag and score_run")
    add("--mutated", type=Path, metavar="FILE.json", help="what mutate_messages wrote")
    add("--soak", type=Path, metavar="FILE.json", help="what soak_stack wrote")
    add("--load", type=Path, metavar="FILE.json", help="what load.test wrote")
    add("--outages", type=Path, metavar="FILE.json", help="what outage.test wrote")
    add("--bounds", type=Path, metavar="FILE.yaml", help="bounds of faults' effects; fails beyond")
    add("--made", default="", metavar="TEXT", help="commit, date and seed, for the page")
    add("--page", required=True, type=command_line.output_file, metavar="FILE.md", help="the report")
    add("--out", type=command_line.output_file, metavar="FILE.json", help="all runs")
    add("--faults", nargs="+", default=[], metavar="PART", help="those with this in their name (default all)")
    command_line.add_number(parser, "--begin", 8.0, "S", "when the faults begin")
    return parser
