# SPDX-License-Identifier: BSD-3-Clause
"""CARMEN logs of a few lines, made up so that everything in them can be worked out by hand."""

START = 1000.0  # s


def flaser(time, robot, laser=None, ranges=(1.0, 2.0, 3.0, 4.0), kind="FLASER"):
    """Returns a line of a front laser; robot, laser: x, y, yaw (None: the robot's)."""
    laser = robot if laser is None else laser
    return join(kind, len(ranges), *ranges, *laser, *robot, stamp(time), "host", f"{time:.6f}")


def robot_laser(time, robot, laser, ranges, step=0.01, remissions=(), range_max=50.0):
    """Returns a line of ROBOTLASER1, with the first beam at -0.5 rad."""
    head = (0, -0.5, step * len(ranges), step, range_max, 0.01, 0)
    tail = (0.1, 0.2, 1.0, 2.0, 1e6, stamp(time), "host", f"{time:.6f}")
    return join(
        "ROBOTLASER1",
        *head,
        len(ranges),
        *ranges,
        len(remissions),
        *remissions,
        *laser,
        *robot,
        *tail,
    )


def odom(time, robot):
    """Returns a line of odometry."""
    return join("ODOM", *robot, 0.0, 0.0, 0.0, stamp(time), "host", f"{time:.6f}")


def stamp(time):
    """Returns `time` (s after START) as the log writes it."""
    return f"{START + time:.6f}"


def join(*words):
    """Returns the words as one line."""
    return " ".join(str(word) for word in words)


def write_log(path, *lines):
    """Writes the lines to `path` (Path), which it returns."""
    path.write_text("".join(line + "\n" for line in lines))
    return path
