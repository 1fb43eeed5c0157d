# SPDX-License-Identifier: BSD-3-Clause
"""Runs a page's command blocks as written, in one fresh shell."""

import os
import re
import signal
import socket
import subprocess
from dataclasses import dataclass, replace

TREE = ("config", "doc", "launch", "rosbag_fixtures", "scripts", "README.md")
CLEAN_PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
KEPT_VARIABLES = ("HOME", "USER", "LANG", "TMPDIR")
# What programs print on errors that do not show in roslaunch's exit code.
FAILURE = re.compile(r"\[FATAL\]|Traceback \(most recent|RLException|Couldn't find executable|"
                     r"couldn't set parameters|process has died")
LAUNCH = re.compile(r"^(\S+/env\.sh )?roslaunch ")
TERMINATION_TIME = 20  # s for roslaunch to end its nodes
LINES_SHOWN = 30


@dataclass
class Outcome:
    """The result of a page: `error` is empty if all its blocks ran."""

    error: str
    line: int  # of the block that was running at the end
    output: str


def make_folder(folder, source, environment_folder, installed):
    """Links what is at the root of the sources into `folder`.

    devel/setup.bash is that of `environment_folder`. For an installed tree, config, launch and the
    bags are the installed ones.
    """
    share = environment_folder / "share" / "datmo_fusion"
    for name in TREE:
        position = share / name if installed and (share / name).exists() else source / name
        if position.exists():
            (folder / name).symlink_to(position)
    # No link: rosrun ignores what is below PACKAGE/build, which a link would hide.
    (folder / "devel").mkdir()
    (folder / "devel" / "setup.bash").write_text(f"source '{environment_folder}/setup.bash'\n")


def find_files(names, data):
    """Returns the paths of all `names` below `data` by name, or None if one is missing."""
    found = {}
    for name in names:
        paths = sorted(data.rglob(name)) if data else []
        if not paths:
            return None
        found[name] = paths[0]
    return found


def link_files(found, folder):
    """Puts downloaded files into `folder`; a KITTI drive into the folder of its date."""
    for name, path in found.items():
        date = re.match(r"(\d{4}_\d{2}_\d{2})_drive", name)
        link, target = (date.group(1), path.parent) if date else (name, path)
        if not (folder / link).exists():
            (folder / link).symlink_to(target)


def free_port():
    with socket.socket() as probe:
        probe.bind(("", 0))
        return probe.getsockname()[1]


def shell_environment(folder):
    """Returns the environment of a new login: no ROS, no workspace, no display, its own master."""
    return {
        **{name: os.environ[name] for name in KEPT_VARIABLES if name in os.environ},
        "PATH": CLEAN_PATH,
        "ROS_MASTER_URI": f"http://localhost:{free_port()}",
        "ROS_HOSTNAME": "localhost",
        "ROS_HOME": str(folder / ".ros"),
        "MPLBACKEND": "Agg",
    }


def launch_checks(block, page):
    """A block without mark that has roslaunch check each of a block's command lines and start nothing.

    Paths of examples, /path/to/NAME, lead to the demonstrator's sensor set (config:=) or to a small
    file, machines:= to what the page (list of its blocks) has as machines. Returns None where no line
    of the block calls roslaunch, alone or by a machine's env.sh.
    """
    joined = re.sub(r"\\\n\s*", " ", block.text).splitlines()
    lines = [LAUNCH.sub("roslaunch --nodes ", line) for line in joined if LAUNCH.match(line)]
    if not lines:
        return None
    text = re.sub(r"config:=/path/to/\S+", "config:=config/demonstrator.yaml", "\n".join(lines))
    text = re.sub(r":=/path/to/\S+", ":=$PWD/example.yaml", text)
    text = re.sub(r"machines:=/\S+", "machines:=$PWD/machines.launch", text)
    machines = next((each.text for each in page if "<machine " in each.text), "<launch />\n")
    before = ["source devel/setup.bash", "echo 'example: 0' >example.yaml",
              f"cat >machines.launch <<'END'\n{machines}END"]  # fmt: skip
    return replace(block, lines=[*before, *text.splitlines()], needs="")


def script_of(blocks, progress):
    """Returns one script of all blocks; it writes each block's line to the
    file `progress` as it begins."""
    return "".join(f"echo {block.line} >'{progress}'\n{block.text}" for block in blocks)


def stop(process):
    """Ends the shell and all that it started; roslaunch ends its nodes when it is terminated."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, number)
            process.wait(TERMINATION_TIME)
        except (ProcessLookupError, subprocess.TimeoutExpired):
            continue


def run_script(script, folder, timeout):
    """Returns (exit code or None after `timeout` s, output) of `bash -e` on the script."""
    log = folder / ".output"
    with open(log, "wb") as output:
        process = subprocess.Popen(
            ["bash", "-e", str(script)],
            cwd=folder,
            env=shell_environment(folder),
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        try:
            code = process.wait(timeout)
        except subprocess.TimeoutExpired:
            code = None
        stop(process)
    return code, log.read_text(errors="replace")


def run_blocks(blocks, folder, timeout):
    """Runs the blocks in `folder`, one after the other in one shell; returns an Outcome."""
    progress, script = folder / ".progress", folder / ".commands"
    script.write_text(script_of(blocks, progress))
    code, output = run_script(script, folder, timeout)
    line = int(progress.read_text()) if progress.exists() else 0
    failure = FAILURE.search(output)
    if code is None:
        error = f"not at its end after {timeout:g} s"
    elif code != 0:
        error = f"exit code {code}"
    elif failure:
        start = output.rfind("\n", 0, failure.start()) + 1
        error = f"said: {output[start:].splitlines()[0]}"
    else:
        error = ""
    return Outcome(error, line, "\n".join(output.splitlines()[-LINES_SHOWN:]))
