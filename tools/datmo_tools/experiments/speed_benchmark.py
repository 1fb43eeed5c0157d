# SPDX-License-Identifier: BSD-3-Clause
"""Measures the speed of the stack: the command line, and what is measured in which order."""

import subprocess
import tempfile
from pathlib import Path

from tqdm import tqdm

from datmo_tools import command_line, programs
from datmo_tools.errors import InputError
from datmo_tools.experiments import speed_live, speed_micro, speed_report
from datmo_tools.experiments.speed_context import describe, devel_space
from datmo_tools.experiments.speed_live import LiveDrive

DESCRIPTION = """\
Measures the speed of the stack. micro: each hot path by itself, in processor time, and the ratio to
its lower bound (its limit, measured in the same run). live: the nodelets on a drive that is played
in real time, with the demonstrator's settings, with heavy ones, and with the demonstrator's stereo
camera, the recommended level of fusion and the risk of contact; with --images, on that drive
without and with a network that classifies its objects: latency from the publication of a scan by
another process to the arrival of its tracks there, including both transports; processor time and
memory of the nodelets' process. Each live figure is the median over the runs. All figures are
written to a JSON file. --compare prints two such files side by side, or one next to a new
measurement, and compares the ratios to the limits, which hold on any machine: the exit code is 3 if
one of them has grown by more than its spread."""

SLOWER = 3  # exit code

QUICK = "--duration=3"  # s of a drive
ALL_LEVELS = ("early_tracks:=true", "fusion:=recommended", "risk:=true")
CAMERA = ("stereo/enabled=true",)
HEAVY_SCANNER = ("scanner/beam_spacing=0.25", "scanner/horizontal_opening=0.25")


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    parser = _parser()
    values = parser.parse_args(arguments)
    if len(values.compare) > 2:
        parser.error("--compare: expected OLD.json, or OLD.json NEW.json")
    verdicts = []
    code = command_line.run("speed_benchmark", lambda: verdicts.extend(_work(values)), "report")
    return code or (SLOWER if verdicts else 0)


def _work(values):
    """Measures, compares, or both; returns the names of the hot paths that have become slower."""
    reports = [speed_report.read(file) for file in values.compare]
    if len(reports) < 2:
        reports.append(_measure(values))
    if len(reports) < 2:
        return []
    print(speed_report.comparison(*reports))
    print("\n" + speed_report.judgement(*reports))
    return speed_report.slower(*reports)


def _measure(values):
    parts = values.parts or speed_report.MEASURED
    unknown = set(parts) - set(speed_report.MEASURED)
    if unknown:
        raise InputError(f"{sorted(unknown)[0]}: expected micro or live")
    report = {"format": speed_report.FORMAT, "context": describe(values.source, values.build)}
    with tempfile.TemporaryDirectory(prefix="benchmark_") as folder:
        if "micro" in parts:
            program = _program(values, "benchmark_hot_paths")
            report["micro"] = speed_micro.measure(program, Path(folder), values.quick)
        if "live" in parts:
            report["live"] = _measure_live(values, Path(folder))
    command_line.write_json(values.out, report)
    print(speed_report.table(report))
    print(f"\nall of it: {values.out}")
    return report


def _measure_live(values, folder):
    """Returns figures of each drive, the median over the runs."""
    launch_file = values.source / "benchmark" / "live_load.launch"
    drives = _drives(values, folder)
    runs = {name: [] for name in drives}
    count = 1 if values.quick else values.runs
    for name, drive in tqdm([*drives.items()] * count, "live runs"):
        runs[name].append(speed_live.measure(drive, launch_file, folder))
    return {name: speed_report.medians(figures) for name, figures in runs.items()}


def _drives(values, folder):
    """Returns the intersection, with the demonstrator, with a heavy scanner, and with the
    demonstrator's camera; and the drive with images, if any."""
    fixtures = values.source / "rosbag_fixtures"
    scene = fixtures / "scenes" / "intersection.yaml"
    heavy_bag, stereo_bag = folder / "heavy.bag", folder / "stereo.bag"
    _simulate(values, scene, heavy_bag, HEAVY_SCANNER)
    _simulate(values, scene, stereo_bag, CAMERA)
    demonstrator = values.source / "config" / "demonstrator.yaml"
    heavy = values.source / "benchmark" / "heavy.yaml"
    play_options = QUICK if values.quick else ""
    drives = {
        "demonstrator": LiveDrive(fixtures / "intersection.bag", demonstrator, play_options),
        "heavy": LiveDrive(heavy_bag, heavy, play_options),
        "stereo camera and risk": LiveDrive(stereo_bag, demonstrator, play_options, ALL_LEVELS),
    }
    if values.images:
        bag, network = (file.resolve() for file in values.images)
        config = values.source / "config" / "kitti.yaml"
        drives["images, not used"] = LiveDrive(bag, config, play_options)
        drives["images and network"] = LiveDrive(bag, config, play_options, (f"network:={network}",))
    return drives


def _simulate(values, scene, bag, options):
    program = _program(values, "simulate")
    done = subprocess.run([program, scene, bag, "--quiet", *programs.settings(options)], check=False)
    if done.returncode != 0:
        raise InputError(f"{scene}: simulate failed with exit code {done.returncode}")


def _program(values, name):
    folder = devel_space(values.build) / "lib" / "datmo_fusion"
    programs.check(folder, (name,))
    return folder / name


def _parser():
    parser = command_line.new_parser("speed_benchmark", DESCRIPTION)
    add = parser.add_argument
    add("parts", nargs="*", metavar="micro|live", help="what to measure (default: both)")
    add("--compare", nargs="+", type=Path, default=[], metavar="FILE.json",
        help="OLD NEW: print both side by side instead; OLD: with a new measurement")  # fmt: skip
    add("--runs", type=command_line.count, default=3, metavar="N",
        help="live runs (default %(default)s)")  # fmt: skip
    add("--images", nargs=2, type=Path, metavar=("DRIVE.bag", "MODEL"),
        help="a drive of kitti_to_bag --images, and the file of a network: also measures live "
        "latency without and with it")  # fmt: skip
    add("--quick", action="store_true", help="one short run of everything, as a check")
    add("--source", type=Path, default=Path.cwd(), metavar="DIR", help="sources (default: here)")
    add("--build", type=Path, default=Path("build"), metavar="DIR",
        help="build folder (default %(default)s)")  # fmt: skip
    add("--out", type=command_line.output_file, default=Path("benchmark.json"), metavar="FILE.json",
        help="all figures (default %(default)s)")  # fmt: skip
    return parser
