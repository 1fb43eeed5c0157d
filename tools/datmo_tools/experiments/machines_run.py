# SPDX-License-Identifier: BSD-3-Clause
"""Runs the stack on three computers, or on one, on a drive in real time, and records outputs."""

import contextlib
import json
import math
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import NamedTuple

from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError
from datmo_tools.pose_path import read_messages
from datmo_tools.programs import call

COMPUTERS = 3
COMPUTER_OF = {"sensors": 0, "stereo": 1, "perception": 2, "risk": 0}  # which computer has which part
PORT = 11311
PATIENCE = 180.0  # s, for all to be loaded; many times what a busy machine needs
RUN_UP = 5.0  # s, from start command to first message: lost packets are resent after 1 s, 2 s
OUTPUT = {"sensors": "tracks", "stereo": "objects/stereo", "perception": "tracks", "risk": "risks"}


class Drive(NamedTuple):
    """What is played, and what is launched for it."""

    bag: Path
    config: Path
    arguments: tuple  # words for perception.launch
    options: tuple  # the same for run_bag
    topics: dict  # played topics, by the part on whose computer their devices are
    nodelets: tuple  # that must have reported before it begins
    parts: tuple  # those that are used
    seconds: float = float("inf")  # of the bag


class Kill(NamedTuple):
    """Kills a part's process."""

    part: str
    after: float  # s, since the drive began


class Result(NamedTuple):
    """Result of one run; times in s."""

    begin: float  # time of the first message
    messages: dict  # [stamp, arrival, tracks] of each message, by topic
    stack: list  # [arrival, sentence, values] of each report
    kills: list  # [part, when]


def run(drive, network, split, launch_file, folder, kills=()):
    """Runs a drive and returns its Result.

    network: LossyNetwork of COMPUTERS; split: each part is on its computer, else all are on the first
    computer; launch_file: perception.launch; folder (Path): for logs; kills: in order.
    """
    computer_of = (lambda part: COMPUTER_OF[part]) if split else (lambda _part: 0)
    with _Processes(network, launch_file.parents[1], folder) as processes:
        processes.start_roslaunch(_launch_words(drive, network, split, launch_file, folder))
        recorder = processes.start_tool("record_now", computer_of("perception"), folder / "recorded.json")
        players = [processes.start_tool("play_now", computer_of(part), drive.bag, "--seconds", str(drive.seconds),
                                        "--nodelets", *drive.nodelets, "--topics", *topics)
                   for part, topics in drive.topics.items()]
        for player in players:
            processes.expect(player, "ready")
        begin = time.time() + RUN_UP
        for player in players:
            player.stdin.write(f"{begin}\n")
            player.stdin.flush()
        killed = [[kill.part, _kill(network, computer_of(kill.part), kill, begin, split)] for kill in kills]
        for player in players:
            processes.expect(player, "played")
        recorder.stdin.close()
        recorder.wait(PATIENCE)
        recorded = json.loads((folder / "recorded.json").read_text(encoding="utf-8"))
    return Result(begin, recorded["messages"], recorded["stack"], killed)


def on_bag(drive, programs, folder):
    """Returns the Result of run_bag on the whole drive, independent of timing; arrivals are NaN."""
    computed = folder / "computed.bag"
    call(programs / "run_bag", drive.bag, computed, "--config", drive.config, "--quiet", *drive.options)
    with opened(drive.bag) as bag:
        begin = bag.get_start_time()
    messages = [[message.header.stamp.to_sec(), math.nan, track_positions(message)]
                for message, _ in read_messages(computed, "/tracks")]
    return Result(begin, {"tracks": messages}, [], [])


def track_positions(message):
    """Returns id, x and y (m) of the tracks in a message."""
    return [(track.id, track.pose.position.x, track.pose.position.y) for track in getattr(message, "tracks", ())]


def recovery(result, kill):
    """Returns the time (s) from a kill (of result.kills) to the result of a later scan, or None."""
    part, when = kill
    arrivals = [arrival for stamp, arrival, _ in result.messages[OUTPUT[part]] if stamp > when]
    return min(arrivals) - when if arrivals else None


def latencies(result, topic):
    """Returns the time from the measurement to the arrival (s), of each message."""
    return [arrival - stamp for stamp, arrival, _ in result.messages[topic]]


def by_time(result, topic):
    """Returns the tracks of each message by its time of the drive, ms."""
    return {round(1e3 * (stamp - result.begin)): tracks for stamp, _, tracks in result.messages[topic]}


def _launch_words(drive, network, split, launch_file, folder):
    words = [str(launch_file), f"config:={drive.config}", *drive.arguments]
    if split:
        words += [f"machines:={_write_machines(network, folder)}"]
        words += [f"{part}_machine:={part}" for part in COMPUTER_OF]
    spaces = [f"{network.address(i)}={network.name(i)}" for i in range(COMPUTERS)]
    return [sys.executable, "-m", "datmo_tools", "experiments.namespaced_roslaunch", *spaces, "--",
            "--port", str(PORT), *words]


def _write_machines(network, folder):
    """Writes the launch file with the machines, and each one's script for its environment."""
    tags = ""
    for part, computer in COMPUTER_OF.items():
        loader = folder / f"computer_{computer}.sh"
        loader.write_text(f'#!/bin/sh\nexport ROS_IP={network.address(computer)}\nexec "$@"\n', encoding="utf-8")
        loader.chmod(0o755)
        tags += f'<machine name="{part}" address="{network.address(computer)}" env-loader="{loader}" />'
    file = folder / "machines.launch"
    file.write_text(f"<launch>{tags}</launch>", encoding="utf-8")
    return file


def _kill(network, computer, kill, begin, split):
    """Kills the process; returns when it was done."""
    time.sleep(max(0.0, begin + kill.after - time.time()))
    manager = f"perception_{kill.part}" if split and kill.part != "perception" else "perception"
    process = _process_of(network.name(computer), manager)
    when = time.time()
    os.kill(process, signal.SIGKILL)
    return when


def _process_of(namespace, node):
    """Returns the process of a node, by the name that roslaunch put on its command line."""
    listed = subprocess.run(["ip", "netns", "pids", namespace], stdout=subprocess.PIPE, encoding="utf-8", check=True)
    for process in listed.stdout.split():
        with contextlib.suppress(OSError):
            words = Path(f"/proc/{process}/cmdline").read_bytes().decode(errors="replace").split("\0")
            if "manager" in words and f"__name:={node}" in words:
                return int(process)
    raise InputError(f"{node}: no such process in {namespace}, expected a nodelet manager")


class _Processes:
    """Context manager of processes on the computers, which end with it."""

    def __init__(self, network, package, folder):
        self._network, self._package, self._folder = network, package, folder
        self._started = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in reversed(self._started):  # roslaunch last: it has the master
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
            for pipe in filter(None, (process.stdin, process.stdout)):
                with contextlib.suppress(OSError):
                    pipe.close()
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(PATIENCE)

    def start(self, name, computer, words):
        """Starts a process; its errors go to a log with its name; its output can be read."""
        environment = dict(os.environ, ROS_MASTER_URI=f"http://{self._network.address(0)}:{PORT}",
                           ROS_IP=self._network.address(computer), ROS_LOG_DIR=str(self._folder / "ros"),
                           ROS_HOME=str(self._folder / "ros"),
                           ROS_PACKAGE_PATH=f"{self._package}:{os.environ.get('ROS_PACKAGE_PATH', '')}")
        environment.pop("ROS_HOSTNAME", None)
        log = self._folder / f"{name}_{len(self._started)}.log"
        with log.open("wb") as out:
            process = subprocess.Popen(self._network.command(computer, words), env=environment, text=True,
                                       stdin=subprocess.PIPE, stdout=out if name == "roslaunch" else subprocess.PIPE,
                                       stderr=out)
        self._started.append(process)
        return process

    def start_roslaunch(self, words):
        """Starts roslaunch on the first computer. If it ends, everything else does, too."""
        launch = self.start("roslaunch", 0, words)

        def watch():
            launch.wait()
            for process in self._started:
                process.terminate()
        threading.Thread(target=watch, daemon=True).start()

    def start_tool(self, name, computer, *words):
        return self.start(name, computer, [sys.executable, "-m", "datmo_tools", f"experiments.{name}", *words])

    @staticmethod
    def expect(process, word):
        """Waits until it has printed a line with the word. Raises InputError if it ends before."""
        while line := process.stdout.readline():  # rospy prints other lines, too
            if line.strip() == word:
                return
        raise InputError(f"{' '.join(process.args)}: ended, expected it to say {word}; roslaunch has ended, too?")
