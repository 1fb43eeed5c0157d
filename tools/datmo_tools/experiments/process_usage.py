# SPDX-License-Identifier: BSD-3-Clause
"""What a process uses of the computer, from Linux's /proc."""

import os
from pathlib import Path
from typing import NamedTuple

TICKS = os.sysconf("SC_CLK_TCK")  # per second
UTIME, STIME = 11, 12  # fields of /proc/PID/stat behind the name (proc(5): 14 and 15 from 1)
KIB_IN_MIB = 1024


class ProcessUsage(NamedTuple):
    """A process at one time."""

    time: float  # s, of the reader's clock
    cpu: float  # s, used since its start by all of its threads
    resident: float  # MiB, memory in use
    peak: float  # MiB, the most that was ever in use


def read(pid, time, proc=Path("/proc")):
    """ProcessUsage of the process `pid`, or None if it is gone."""
    try:
        stat = (proc / str(pid) / "stat").read_text()
        status = (proc / str(pid) / "status").read_text()
        fields = stat.rpartition(")")[2].split()  # the name may hold spaces and brackets
        memory = dict(line.split(":", 1) for line in status.splitlines() if line.startswith("Vm"))
        return ProcessUsage(
            time,
            (int(fields[UTIME]) + int(fields[STIME])) / TICKS,
            _mebibytes(memory["VmRSS"]),
            _mebibytes(memory["VmHWM"]),
        )
    except (OSError, KeyError):  # a process that has ended has no memory any more
        return None


def _mebibytes(text):
    return int(text.split()[0]) / KIB_IN_MIB


def summarize(samples, begin, end):
    """Use between two times (s), of samples in their order: at least two of them in between.

    Memory grows from the end of the first quarter on: by then what is allocated once is there.
    """
    within = [sample for sample in samples if begin <= sample.time <= end]
    settled = next(s for s in within if s.time >= begin + 0.25 * (end - begin) or s is within[-1])
    first, last = within[0], within[-1]
    return {
        "cpu_share": (last.cpu - first.cpu) / (last.time - first.time),
        "memory_peak_mib": last.peak,
        "memory_growth_mib": last.resident - settled.resident,
    }
