# SPDX-License-Identifier: BSD-3-Clause
"""Measures the live chain on a drive in real time: latency, and its process's resource usage."""

import contextlib
import json
import os
import signal
import subprocess
import time
import xmlrpc.client
from pathlib import Path
from typing import NamedTuple

import numpy as np

from datmo_tools.errors import InputError
from datmo_tools.experiments import process_usage

CALLER = "/benchmark"
MANAGER = "/perception"  # the process of all nodelets
SAMPLE_PERIOD = 0.2  # s
MILLISECONDS = 1e3


class LiveDrive(NamedTuple):
    """What is played to the live chain, and its settings."""

    bag: Path
    config: Path
    play_options: str = ""  # for rosbag play
    launch_arguments: tuple = ()  # of live_load.launch, besides these


def measure(drive, launch_file, folder):
    """Returns figures of one run (dict); benchmark/record_latency.cpp defines latency.

    launch_file: live_load.launch; folder: for its log and the recorded times. The ROS master
    is that of ROS_MASTER_URI, started for the run.
    """
    recorded, log = folder / "latency.json", folder / "live.log"
    samples = _run(drive, launch_file, recorded, log)
    try:
        times = json.loads(recorded.read_text(encoding="utf-8"))
        return summarize(times, samples)
    except (OSError, ValueError, StopIteration, IndexError) as error:
        raise InputError(f"{drive.bag}: no scan led to tracks; {_last_line(log)}") from error


def summarize(times, samples):
    """Returns figures of one run: `times` from record_latency, `samples` of the process."""
    return {
        "scans": len(times["latency"]) + times["unanswered"],
        "unanswered": times["unanswered"],
        "latency_ms": _distribution(times["latency"]),
        "processing_ms": {
            stage: _distribution(values) for stage, values in times["stages"].items()
        },
        **process_usage.summarize(samples, times["first_scan"], times["last_scan"]),
    }


def _distribution(seconds):
    median, percentile_99, worst = MILLISECONDS * np.quantile(seconds, [0.5, 0.99, 1.0])
    return {"median": median, "percentile_99": percentile_99, "worst": worst}


def _run(drive, launch_file, recorded, log):
    """Plays the drive; returns the ProcessUsage samples of the nodelets' process."""
    command = ["roslaunch", "--port", _master_port(), str(launch_file)]
    command += [f"bag:={drive.bag}", f"config:={drive.config}", f"output:={recorded}"]
    command += [f"play_options:={drive.play_options}", *drive.launch_arguments]
    samples = []
    with log.open("wb") as out:
        launch = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT)
        try:
            pid = None
            while launch.poll() is None:
                pid = pid or _manager_pid()
                sample = pid and process_usage.read(pid, time.monotonic())
                if sample:
                    samples.append(sample)
                time.sleep(SAMPLE_PERIOD)
        finally:
            launch.send_signal(signal.SIGINT)  # roslaunch ends its nodes
            launch.wait()
    return samples


def _master_port():
    if "ROS_MASTER_URI" not in os.environ:
        raise InputError("ROS_MASTER_URI is not set, expected the environment of a built tree")
    return os.environ["ROS_MASTER_URI"].rstrip("/").rpartition(":")[2]


def _manager_pid():
    """Returns the process id of the nodelet manager, None before it exists."""
    with contextlib.suppress(OSError, xmlrpc.client.Error):
        master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
        found, _, uri = master.lookupNode(CALLER, MANAGER)
        if found == 1:
            return xmlrpc.client.ServerProxy(uri).getPid(CALLER)[2]
    return None


def _last_line(log):
    lines = log.read_text(encoding="utf-8", errors="replace").strip().splitlines()
    return f"roslaunch's last line: {lines[-1]}" if lines else "roslaunch printed nothing"
