# SPDX-License-Identifier: BSD-3-Clause
"""Reports the state of a Slurm job in Snakemake's words: running, success or failed."""

import subprocess
import sys

# Of the states that squeue(1) lists; in all others the job has ended, or will not go on by itself.
GOING_ON = (
    "PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "STOPPED", "REQUEUED", "RESIZING",
    "SIGNALING", "STAGE_OUT",
)  # fmt: skip
UNKNOWN = "running"  # for a job whose state is not available now: Snakemake asks again


def main():
    """Prints the state of the job named on the command line."""
    print(state_of(sys.argv[-1]))
    return 0


def state_of(job):
    """Returns the state from the accounting, else from the controller, which forgets it later."""
    for command, read in ((["sacct", "-nXP", "-o", "State", "-j", job], _accounted),
                          (["scontrol", "-o", "show", "job", job], _controlled)):
        try:
            done = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
        except FileNotFoundError:
            continue
        if done.returncode == 0:
            state = read(done.stdout)
            if state:
                return _word(state)
        elif "Invalid job id" in done.stderr:
            return "failed"  # forgotten, so it has ended: Snakemake checks its output
    return UNKNOWN


def _accounted(text):
    lines = text.split()
    return lines[0] if lines else ""


def _controlled(text):
    for item in text.split():
        if item.startswith("JobState="):
            return item.partition("=")[2]
    return ""


def _word(state):
    if state == "COMPLETED":
        return "success"
    return "running" if state in GOING_ON else "failed"
