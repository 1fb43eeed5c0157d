# SPDX-License-Identifier: BSD-3-Clause
"""rviz with the arguments given; without a display it says so and ends well, so that the rest goes on.

usage: open_rviz [--frame-prefix PREFIX] [-d FILE] [ARGUMENT OF RVIZ]...

With a prefix, or in a namespace, rviz shows a copy of FILE whose frames have the prefix and whose topics are
in the namespace: one of several vehicles on one master.
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
    """The file to show: `file` itself where one vehicle is alone, else a copy for this one. Raises InputError."""
    namespace = os.environ.get("ROS_NAMESPACE", "")
    if not prefix and not namespace.strip("/"):
        return file
    return write_view(file, prefix, "/" + namespace.strip("/"), os.path.join(rospkg.get_ros_home(), "datmo_fusion"))


def main():
    """Becomes rviz; returns an exit code where it does not."""
    if sys.argv[1:] in (["-h"], ["--help"]):
        print(__doc__)
        return 0
    if not display_opens():
        print(f"rviz is not opened: DISPLAY is '{os.environ.get('DISPLAY', '')}', which is no display "
              "that can be reached; the rest goes on (rviz:=false: without this message; over ssh: "
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
