# SPDX-License-Identifier: BSD-3-Clause
"""Starts rviz with the given arguments; without a display it says so and exits with 0, so that the
rest runs.

usage: open_rviz [--frame-prefix PREFIX] [--show PANEL] [--hide PANEL] [-d FILE] [ARGUMENT OF RVIZ]...

With a prefix, or in a namespace, rviz shows a copy of FILE with prefixed frames and namespaced
topics: one of several vehicles on one master. --show and --hide do so with panels of images, in
such a copy, by their names, and can be repeated.
"""

import argparse
import ctypes
import os
import sys

import rospkg

from datmo_tools.errors import InputError
from datmo_tools.rviz_view import write_view


def display_opens():
    """Whether DISPLAY names a display that can be reached."""
    try:
        x11 = ctypes.CDLL("libX11.so.6")
    except OSError:
        return False
    x11.XOpenDisplay.restype = ctypes.c_void_p
    return bool(os.environ.get("DISPLAY")) and x11.XOpenDisplay(None) is not None


def vehicle_view(file, prefix, shown):
    """Returns the file to show: `file` for a single vehicle with its usual panels, else a copy.

    `shown`: whether a panel is shown, by its name, if other than in the file. Raises InputError.
    """
    namespace = os.environ.get("ROS_NAMESPACE", "").strip("/")
    if not prefix and not namespace and not shown:
        return file
    return write_view(file, prefix, "/" + namespace, os.path.join(rospkg.get_ros_home(), "datmo_fusion"), shown)


def main():
    """Replaces this process by rviz; returns an exit code if it does not."""
    if sys.argv[1:] in (["-h"], ["--help"]):
        print(__doc__)
        return 0
    if not display_opens():
        print(f"rviz is not opened: DISPLAY is '{os.environ.get('DISPLAY', '')}', not a display "
              "that can be reached; the rest runs (rviz:=false: without this message; over ssh: "
              "ssh -X)", file=sys.stderr)
        return 0
    parser = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    parser.add_argument("--frame-prefix", default="")
    parser.add_argument("-d")
    for option in ("--show", "--hide"):
        parser.add_argument(option, action="append", default=[])
    given, others = parser.parse_known_args()
    shown = {**dict.fromkeys(given.show, True), **dict.fromkeys(given.hide, False)}
    try:
        view = ["-d", vehicle_view(os.path.abspath(given.d), given.frame_prefix, shown)] if given.d else []
    except InputError as error:
        print(f"open_rviz: {error}", file=sys.stderr)
        return 1
    os.execvp("rviz", ["rviz", *view, *others])
