# SPDX-License-Identifier: BSD-3-Clause
"""Starts rviz with the given arguments; without a display it says so and exits with 0, so that the
rest runs.

usage: open_rviz [--frame-prefix PREFIX] [-d FILE] [ARGUMENT OF RVIZ]...

With a prefix, or in a namespace, rviz shows a copy of FILE with prefixed frames and namespaced
topics: one of several vehicles on one master.
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


def vehicle_view(file, prefix):
    """Returns the file to show: `file` for a single vehicle, else a copy. Raises InputError."""
    namespace = os.environ.get("ROS_NAMESPACE", "")
    if not prefix and not namespace.strip("/"):
        return file
    return write_view(file, prefix, "/" + namespace.strip("/"), os.path.join(rospkg.get_ros_home(), "datmo_fusion"))


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
    given, others = parser.parse_known_args()
    try:
        view = ["-d", vehicle_view(os.path.abspath(given.d), given.frame_prefix)] if given.d else []
    except InputError as error:
        print(f"open_rviz: {error}", file=sys.stderr)
        return 1
    os.execvp("rviz", ["rviz", *view, *others])
