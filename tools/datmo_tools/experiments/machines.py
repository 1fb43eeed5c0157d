# SPDX-License-Identifier: BSD-3-Clause
"""Compares the stack on three computers with a lossy network to one computer: the report."""

import contextlib
import statistics
import tempfile
from pathlib import Path

import numpy as np
import rosbag
from tqdm import tqdm

from datmo_tools import command_line
from datmo_tools.errors import InputError
from datmo_tools.evaluate.pair_choice import nearest_pairs
from datmo_tools.experiments import lossy_network, machines_run, simulated_run
from datmo_tools.experiments.machines_run import Drive, Kill
from datmo_tools.programs import StepFailed
from datmo_tools.text_table import aligned, rounded

DESCRIPTION = """\
Plays a drive in real time to the stack on one computer, and on three (network namespaces) whose
network delays each packet and loses some; kills the process of each part in turn. Prints how far
the tracks agree with those of run_bag, which does not depend on timing, the latency, how soon each
part works again, and the clocks' offsets, whose true value is 0. Needs root."""

MOTION_TOPICS = ("/odometry", "/tf", "/tf_static")
MOTION_ALONE = 0.5  # s
PAIRED = 0.5  # m: tracks of two runs that are nearer to each other belong to one object
MILLISECONDS = 1e3
KILL_AFTER = 5.0  # s, of the drive
FIXTURE_TOPICS = {"sensors": ("/echoes", "/odometry", "/tf", "/tf_static")}
STEREO_TOPICS = {
    "sensors": ("/scan", "/odometry", "/tf", "/tf_static"),
    "stereo": ("/stereo/points2", "/stereo/point_velocities", "/stereo/left/camera_info",
               "/stereo/right/camera_info"),
}  # fmt: skip
# Enough points for objects, but few enough for the test's own reader to keep up.
STEREO_OPTIONS = ("stereo/enabled=true", "scanner/echoes=1", "stereo/column_step=4", "stereo/row_step=4")
ONE_SCANNER = "scan_merge: {sources: {rear: {use: false}}}\n"  # so that `sensors` has something to do
SCANNER_NODELETS = ("grid_slam", "moving_objects", "tracker", "risk")


def fixture_drive(repository, folder):
    """Returns the scanner's chain and risk, on the committed bag (repository: Path)."""
    bag = folder / "scanner.bag"
    begin_with_motion(repository / "rosbag_fixtures/intersection.bag", bag)
    return Drive(bag, repository / "config/demonstrator.yaml", ("risk:=true",), (), FIXTURE_TOPICS, SCANNER_NODELETS, ())


def begin_with_motion(source, bag):
    """Copies a bag (Paths) without the measurements of its first half second, except motion.

    Without this the first scan has no older odometry: if it comes first, the map begins
    differently.
    """
    with rosbag.Bag(str(source)) as read, rosbag.Bag(str(bag), "w") as written:
        begin = read.get_start_time()
        for topic, message, recorded in read.read_messages():
            if topic in MOTION_TOPICS or recorded.to_sec() - begin > MOTION_ALONE:
                written.write(topic, message, recorded)


def stereo_drive(repository, programs, folder):
    """Returns a drive for all four parts: simulated into the folder (Path)."""
    scene = repository / "rosbag_fixtures/scenes/intersection.yaml"
    bag, config = folder / "stereo.bag", folder / "stereo.yaml"
    simulated_run.record(simulated_run.SimulatedDrive(scene, STEREO_OPTIONS), programs, folder / "simulated.bag")
    begin_with_motion(folder / "simulated.bag", bag)
    shipped = (repository / "config/demonstrator.yaml").read_text(encoding="utf-8")
    config.write_text(shipped + ONE_SCANNER, encoding="utf-8")
    arguments = ("fusion:=recommended", "risk:=true", "merge_scans:=true", "front_scan:=scan")
    nodelets = (*SCANNER_NODELETS, "scan_merge", "stereo_objects", "stereo_tracker", "track_fusion", "road_border")
    options = ("--fusion", "recommended", "--merge-scans", "front_scan:=/scan")
    return Drive(bag, config, arguments, options, STEREO_TOPICS, nodelets, tuple(machines_run.COMPUTER_OF))


def sameness(one, other):
    """Returns how far the tracks of two Results agree (dict)."""
    first, second = (machines_run.by_time(result, "tracks") for result in (one, other))
    common = sorted(set(first) & set(second))
    distances, alone = paired([(first[when], second[when]) for when in common])
    return {
        "lists": len(first),
        "lists_missing": len(set(first) - set(second)),
        "tracks": sum(len(first[when]) for when in common),
        "unpaired": alone,
        "median_m": float(np.median(distances)) if distances else None,
        "p99_m": float(np.quantile(distances, 0.99)) if distances else None,
    }


def paired(lists, gate=PAIRED):
    """Returns the distances (m) of all tracks that score_run's matcher pairs, and how many tracks
    are in no pair.

    lists: of (tracks, the other run's tracks) of one time each, track: (id, x, y); gate (m): tracks
    at least this far apart are no pair.
    """
    tables = []
    for first, second in lists:
        one, other = (np.reshape([track[1:] for track in tracks], (-1, 2)) for tracks in (first, second))
        apart = np.linalg.norm(one[:, np.newaxis] - other, axis=2)
        tables.append(np.where(apart < gate, apart, np.inf))
    pairs = nearest_pairs(tables)
    distances = [float(table[pair]) for table, chosen in zip(tables, pairs) for pair in chosen]
    return distances, sum(sum(table.shape) for table in tables) - 2 * len(distances)


def clock_offsets(result):
    """Returns what `stack` last reported on each part's clock, by process (text)."""
    found = {}
    for _, _, values in result.stack:
        found.update({key: value for key, value in values.items() if key.startswith("clock of ")})
    return found


def latency(result, topic):
    """Median and 99th percentile, ms."""
    values = machines_run.latencies(result, topic)
    if not values:
        raise InputError(f"no {topic} received: see the logs")
    return MILLISECONDS * statistics.median(values), MILLISECONDS * float(np.quantile(values, 0.99))


def measure(drive, quality, launch_file, programs, folder):
    """Returns figures of a drive (dict): on one computer, on three, and with each part killed."""
    plans = {"one": (False, ()), "three": (True, ())}
    plans.update({part: (True, [Kill(part, KILL_AFTER)]) for part in drive.parts})
    results = {}
    for name, (split, kills) in plans.items():
        logs = folder / name
        logs.mkdir()
        with lossy_network.LossyNetwork(machines_run.COMPUTERS, quality if split else lossy_network.Quality()) as network:
            results[name] = machines_run.run(drive, network, split, launch_file, logs, kills)
    topics = [topic for topic in ("tracks", "risks") if results["one"].messages[topic]]
    reference = machines_run.on_bag(drive, programs, folder)
    return {
        "sameness": {name: sameness(reference, results[name]) for name in ("one", "three")},
        "latency_ms": {name: {topic: latency(results[name], topic) for topic in topics}
                       for name in ("one", "three")},
        "recovery_s": {part: machines_run.recovery(results[part], results[part].kills[0]) for part in drive.parts},
        "clocks": clock_offsets(results["three"]),
    }  # fmt: skip


def table(name, figures):
    """Formats the figures of a drive as lines of text."""
    rows = [(name, "lists", "missing", "tracks", "unpaired", "median [m]", "p99 [m]")]
    for run, same in figures["sameness"].items():
        rows.append((f"tracks: run_bag, {run}", *(str(same[key]) for key in ("lists", "lists_missing", "tracks", "unpaired")),
                     rounded(same["median_m"], 4), rounded(same["p99_m"], 4)))
    delays = [("latency [ms]", "median", "p99")]
    for run, topics in figures["latency_ms"].items():
        delays += [(f"{topic}: {run}", *(rounded(value, 1) for value in values)) for topic, values in topics.items()]
    again = [("killed", "works again after [s]")]
    again += [(part, rounded(seconds, 2)) for part, seconds in figures["recovery_s"].items()]
    clocks = [("clock", "offset")] + [(key.replace("clock of ", ""), value) for key, value in figures["clocks"].items()]
    return "\n\n".join(aligned(part) for part in (rows, delays, again, clocks) if len(part) > 1)


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run("machines", lambda: _campaign(values), "report")


def _campaign(values):
    reason = lossy_network.why_not()
    if reason is not None:
        raise InputError(reason)
    quality = lossy_network.Quality(values.delay / MILLISECONDS, values.jitter / MILLISECONDS, values.loss, values.seed)
    launch_file = values.repository / "launch/perception.launch"
    figures = {}
    with contextlib.ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="machines_")))
        drives = {"scanner": lambda: fixture_drive(values.repository, folder),
                  "scanner and stereo": lambda: stereo_drive(values.repository, values.programs, folder)}
        for i, (name, make) in enumerate(tqdm(drives.items(), "drives")):
            logs = folder / str(i)
            logs.mkdir()
            try:
                figures[name] = measure(make(), quality, launch_file, values.programs, logs)
            except StepFailed as error:
                raise InputError(f"{name}: {error}") from error
    print("\n\n".join(table(name, of_drive) for name, of_drive in figures.items()))
    command_line.write_json(values.json, figures)


def _parser():
    parser = command_line.new_parser("machines", DESCRIPTION)
    parser.add_argument("repository", type=Path, help="folder of the sources")
    parser.add_argument("--programs", type=Path, required=True, help="folder of the built programs")
    command_line.add_number(parser, "--delay", 20.0, "MS", "of each packet")
    command_line.add_number(parser, "--jitter", 10.0, "MS", "jitter of the delay, uniform, +-")
    command_line.add_number(parser, "--loss", 0.02, "SHARE", "of packets that are lost")
    parser.add_argument("--seed", type=int, default=1, help="of delays and losses (default 1)")
    command_line.add_json(parser)
    return parser
