# SPDX-License-Identifier: BSD-3-Clause
"""Checks what roslaunch does not check in a command line: unknown arguments, invalid values, names
of sensor sets without a file, and a stack that already runs on the same master.

usage: check_launch [--devices lidar:=KIND rear_lidar:=KIND rear_lidar_address:=ADDRESS cloud:=TOPIC
                    merge_scans:=BOOL camera:=KIND left_info:=FILE.yaml right_info:=FILE.yaml
                    odometry:=KIND can_signals:=FILE.yaml]

A launch file runs this by <param command>, as a child of roslaunch, before any node starts. Files
that are included by pass_all_args take arguments, too; includes of other packages' launch files
without it are checked by roslaunch itself.
"""

import difflib
import os
import socket
import sys
import xmlrpc.client
from pathlib import Path
from xml.etree import ElementTree

from datmo_tools.errors import InputError
from datmo_tools.yaml_files import load_yaml

MANAGER = "perception"
CALLER = "/check_launch"
# Arguments that take one of a few words; roslaunch accepts any value.
CHOICES = {"fusion": ("none", "low", "object", "track", "recommended"),
           "v2x_part": ("perception", "sensors", "stereo", "risk")}
# Devices of live.launch: the supported kinds, and what to do for other common devices.
DEVICES = {"lidar": ("external", "hokuyo", "sick_lms", "velodyne"), "rear_lidar": ("none", "external", "hokuyo", "sick_lms"),
           "camera": ("none", "external", "usb", "usb_stereo", "images"), "odometry": ("external", "can", "can_imu", "gps_imu", "none")}
CAN = ("can", "can_imu")  # odometry that reads can_signals
CALIBRATIONS = {"usb": ("left_info",), "usb_stereo": ("left_info", "right_info")}  # that cameras need
INSTEAD = {
    "ouster": "start ouster_ros and take lidar:=external cloud:=/ouster/points",
}
# s, to wait for a node to answer; one that has ended is noticed at once. Long enough for a busy
# machine: a stack that does not answer in time is taken for absent.
TIMEOUT = 10.0


def is_argument(word):
    """Whether a word is name:=value; __name:= and the like are ROS's own."""
    return ":=" in word and not word.startswith("_")


def launch_words(command_line):
    """Returns the words after roslaunch's name; none if another program (a test, an editor) loads
    the file."""
    for i, word in enumerate(command_line[:2]):
        if os.path.basename(word) == "roslaunch":
            return command_line[i + 1:]
    return []


def parent_words(process):
    """Returns the command line of a process, by its id; empty without /proc."""
    try:
        text = Path(f"/proc/{process}/cmdline").read_bytes().decode(errors="replace")
    except OSError:
        return []
    return text.split("\0")[:-1]


def arguments_of(file, resolve):
    """Returns the names of the arguments that a launch file takes, including those it passes on.

    `resolve` replaces substitutions in a file name, e.g. $(find PACKAGE). A name that contains an
    argument cannot be resolved here and is skipped: raises what `resolve` raises for it.
    """
    root = ElementTree.parse(file).getroot()
    names = {tag.get("name") for tag in root.findall("arg") if tag.get("value") is None}
    for include in root.iter("include"):
        if include.get("pass_all_args", "").lower() in ("true", "1"):
            names |= arguments_of(resolve(include.get("file")), resolve)
    return names


def refusal(given, known):
    """Returns a sentence on the first unknown argument name, or None."""
    for name in given:
        if name not in known:
            near = difflib.get_close_matches(name, sorted(known), n=1)
            hint = f"did you mean {near[0]}? " if near else ""
            return f"no argument {name}: {hint}There are {', '.join(sorted(known))}"
    return None


def bad_choice(words):
    """Returns a sentence on the first argument whose value is not one of its choices, or None."""
    for name, value in (word.split(":=", 1) for word in words if is_argument(word)):
        if name in CHOICES and value not in CHOICES[name]:
            return f"{name}:={value}: expected one of {', '.join(CHOICES[name])}"
    return None


def missing_configuration(words, folder):
    """Returns a sentence on the first of sensors, preset and config without a file, or None.

    folder: the sensor sets and presets (Path). sensors counts only without config, as in
    perception.launch.
    """
    given = dict(word.split(":=", 1) for word in words if is_argument(word))
    config = given.pop("config", None)
    if config is not None:
        given.pop("sensors", None)
        if not Path(config).is_file():
            return f"config:={config}: no such file; expected the path of a yaml file"
    sets = sorted(file.stem for file in folder.glob("*.yaml"))
    for name in ("sensors", "preset"):
        value = given.get(name, "")
        if value and value not in sets:
            near = difflib.get_close_matches(value, sets, n=1)
            hint = f"did you mean {near[0]}? " if near else ""
            return f"{name}:={value}: no {value}.yaml in {folder}: {hint}There are {', '.join(sets)}"
    return None


def missing_device(words):
    """Returns a sentence on the first device (lidar:=KIND) that is unknown or unusable, or None."""
    given = dict(word.split(":=", 1) for word in words)
    for name, kinds in DEVICES.items():
        kind = given.get(name, kinds[0])
        if kind not in kinds:
            remedy = f"; {INSTEAD[kind]} (doc/live.md)" if kind in INSTEAD else ""
            return f"{name}:={kind}: no driver in this package, expected one of {', '.join(kinds)}{remedy}"
    rear = given.get("rear_lidar", "none")
    if rear != "none" and given.get("cloud"):
        return (f"rear_lidar:={rear} with clouds on {given['cloud']}: expected two planar scanners, as the scan is made of "
                "the clouds alone")
    if rear != "none" and given.get("merge_scans", "true").lower() in ("false", "0"):
        return f"rear_lidar:={rear} with merge_scans:={given['merge_scans']}: expected merge_scans:=true, as nothing else uses its scans"
    if rear not in ("none", "external") and not given.get("rear_lidar_address"):
        return f"rear_lidar:={rear} without rear_lidar_address: expected its address"
    for name in CALIBRATIONS.get(given.get("camera"), ()):
        if not given.get(name):
            return f"camera:={given['camera']} without {name}: expected the path of a calibration"
    return unreadable(given.get("can_signals")) if given.get("odometry") in CAN else None


def unreadable(file):
    """Returns a sentence on a yaml file (path; None or empty: none) that is not loadable, or
    None."""
    try:
        if file:
            load_yaml(file)
    except InputError as error:
        return str(error)
    return None


def words_without_options(words):
    """Returns the words that are not options of roslaunch (-p 11311): its own parser knows which
    take a value."""
    import roslaunch
    return roslaunch._get_optparse().parse_args(list(words))[1]


def check_words(words):
    """Returns a sentence on what is wrong with the words after roslaunch's name, or None."""
    given = [word.split(":=")[0] for word in words if is_argument(word)]
    if not given:
        return None
    # Takes half a second to load, so only if there is something to check.
    from roslaunch.rlutil import resolve_launch_arguments
    from roslaunch.substitution_args import resolve_args
    plain = [word for word in words_without_options(words) if ":=" not in word]
    known = set()
    for file in resolve_launch_arguments(plain):
        known |= arguments_of(file, resolve_args)
    error = refusal(given, known) or bad_choice(words)
    if error or "sensors" not in known:
        return error
    return missing_configuration(words, Path(resolve_args("$(find datmo_fusion)/config")))


def runs(manager, master_uri):
    """Whether a node of this name answers on the master."""
    default_timeout = socket.getdefaulttimeout()
    socket.setdefaulttimeout(TIMEOUT)
    try:
        code, _, uri = xmlrpc.client.ServerProxy(master_uri).lookupNode(CALLER, manager)
        return code == 1 and xmlrpc.client.ServerProxy(uri).getPid(CALLER)[0] == 1
    except (OSError, xmlrpc.client.Error):
        return False
    finally:
        socket.setdefaulttimeout(default_timeout)


def second_stack(words, environment):
    """Returns a sentence if a stack of the same name already runs on the master, or None: each
    would restart its manager whenever the other one ends it.

    environment: that of roslaunch (dict).
    """
    if any(word.startswith("-") and word != "-v" for word in words):
        return None  # --nodes and the like start nothing, -p is another master
    master = environment.get("ROS_MASTER_URI", "http://localhost:11311")
    manager = f"/{environment.get('ROS_NAMESPACE', '')}/{MANAGER}"
    manager = "/" + "/".join(part for part in manager.split("/") if part)
    if not runs(manager, master):
        return None
    return (f"{manager} already runs on {master}: the two would keep ending each other's nodes. "
            "End the other one first, or give this one another ROS_MASTER_URI or ROS_NAMESPACE")


def main():
    """Prints the words checked; returns 1, with a sentence on standard error, if roslaunch must not
    continue."""
    if sys.argv[1:] in (["-h"], ["--help"]):
        print(__doc__)
        return 0
    if sys.argv[1:2] == ["--devices"]:
        words = sys.argv[2:]
        error = missing_device(words)
    else:
        words = launch_words(parent_words(os.getppid()))
        error = check_words(words) or (words and second_stack(words, os.environ))
    if error:
        print(f"ERROR: {error}", file=sys.stderr)
        return 1
    print(" ".join(words))
    return 0
