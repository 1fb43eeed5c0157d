# SPDX-License-Identifier: BSD-3-Clause
"""Reads a process's resource usage from Linux's /proc."""

import os
from pathlib import Path
from typing import NamedTuple

TICKS = os.sysconf("SC_CLK_TCK")  # per second
UTIME, STIME = 11, 12  # fields of /proc/PID/stat after the name (proc(5): 14 and 15 from 1)
KIB_IN_MIB = 1024


class ProcessUsage(NamedTuple):
    """Usage of a process at one time."""

    time: float  # s, of the reader's clock
    cpu: float  # s, processor time of all its threads since its start
    resident: float  # MiB, memory in use
    peak: float  # MiB, maximum so far


def read(pid, time, proc=Path("/proc")):
    """Returns the ProcessUsage of the process `pid`, or None if it has ended."""
    try:
        stat = (proc / str(pid) / "stat").read_text()
        status = (proc / str(pid) / "status").read_text()
        fields = stat.rpartition(")")[2].split()  # the name may contain spaces and brackets
        memory = dict(line.split(":", 1) for line in status.splitlines() if line.startswith("Vm"))
        return ProcessUsage(
            time,
            (int(fields[UTIME]) + int(fields[STIME])) / TICKS,
            _mebibytes(memory["VmRSS"]),
            _mebibytes(memory["VmHWM"]),
        )
    except (OSError, KeyError):  # a process that has ended has no memory
        return None


def _mebibytes(text):
    return int(text.split()[0]) / KIB_IN_MIB


def summarize(samples, begin, end):
    """Returns the usage between two times (s) from samples in order, two or more of them in
    between.

    Memory growth counts from the end of the first quarter on: by then one-time allocations are
    done.
    """
    within = [sample for sample in samples if begin <= sample.time <= end]
    settled = next(s for s in within if s.time >= begin + 0.25 * (end - begin) or s is within[-1])
    first, last = within[0], within[-1]
    return {
        "cpu_share": (last.cpu - first.cpu) / (last.time - first.time),
        "memory_peak_mib": last.peak,
        "memory_growth_mib": last.resident - settled.resident,
    }
