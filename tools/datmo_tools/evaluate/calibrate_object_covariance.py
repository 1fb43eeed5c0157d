# SPDX-License-Identifier: BSD-3-Clause
"""evaluate calibrate_object_covariance."""

from pathlib import Path

from datmo_tools import command_line
from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError
from datmo_tools.evaluate.arguments import add_table
from datmo_tools.evaluate.covariance_report import as_dictionary, as_yaml, summary
from datmo_tools.evaluate.covariance_table import covariance_table
from datmo_tools.evaluate.grid_recordings import CAMERA_INFOS, MOUNTS, mounts_of, view_of
from datmo_tools.evaluate.object_lists import read_lists, read_moving_boxes
from datmo_tools.evaluate.object_pairs import Counts, paired_objects
from datmo_tools.evaluate.plot_files import plotter
from datmo_tools.pose_path import read_path
from datmo_tools.whole_files import write_file

DESCRIPTION = """\
Measures the errors of a stereo camera's objects in range and bearing, by range (thesis 3.3.3:
"calculated empirically", there by hand), and writes it as yaml for object_fusion.

From bags with the objects of both sensors (run_bag --object-fusion) it pairs the lidar's objects
that are tracked as moving (parts of stationary objects may be missing because of the map) with the
camera's, by their near sides (thesis 3.3.2), predicted to one time by the vehicle's poses and the
tracks' velocities: one to one, as score_run matches, within 1 m across the line of sight, and
within 1 m, or 5 m x range / 36 m if that is more, along it, with compatible classes and sizes. The
comparison is of what both saw: the near side along the line of sight, and the bearings of its
corners.

Differences beyond three robust standard deviations are removed from each bin of range; subtracted
from their variance are the lidar's own, and the camera's of the sides that it saw, which
object_fusion adds by itself. In a bin with too few pairs, or where the known variances dominate,
the law that fits all bins is used: a + b range^4 for range, a + b / range^2 for bearing.

Ranges are from the camera's position, which is in its lists. The lidar is assumed to be unbiased;
a mean difference is printed as bias. Object fusion does not correct it: --with-bias adds its square."""

PRODUCT = "table"

TOPICS = {"lidar": "/objects", "stereo": "/objects/stereo", "tracks": "/tracks", "pose": "/pose"}

MIN_PAIRS = 30  # per bin: its variance is known to a quarter (2 / 30, square root)
BIN_WIDTH = 2.0  # m; thesis 3.3.3
RANGE = 36.0  # m; thesis 3.3.3
DISPARITY_SIGMA = 0.25  # px; as the simulator's default


def read_pairs(runs, lidar, stereo, tracks, pose):
    """Returns the list of Pair and the Counts of the bags `runs` (Paths); lidar ... pose: topics.

    Raises InputError for a bag without objects of both.
    """
    pairs, counts = [], Counts()
    for run in runs:
        lists = read_lists(run, (lidar, stereo))
        for topic in (lidar, stereo):
            if topic not in lists:
                raise InputError(
                    f"{run}: nothing on {topic}, expected a bag of run_bag --object-fusion with "
                    f"objects of both sensors on {lidar} and {stereo}"
                )
        new_pairs, new_counts = paired_objects(
            lists[lidar], lists[stereo], read_moving_boxes(run, tracks), read_path(run, pose)
        )
        pairs += new_pairs
        counts += new_counts
    return pairs, counts


def _depth_sigma(drive, disparity_sigma):
    """Returns a function of depth (m) -> standard deviation (m) of a bag's camera, or None."""
    if drive is None:
        return None
    with opened(drive) as bag:
        mounts = mounts_of([message for _, message, _ in bag.read_messages([MOUNTS])])
        infos = {topic: message for topic, message, _ in bag.read_messages(CAMERA_INFOS)}
    return view_of(drive, infos, mounts, RANGE, disparity_sigma).depth_sigma


def _check(values):
    command_line.check_positive(values, "bin_width", "range", "disparity_sigma")
    if values.range <= values.bin_width:
        raise InputError(
            f"--range is {values.range:g}, expected more than --bin-width, {values.bin_width:g}"
        )


def execute(values):
    """Prints the table and writes it to files. Raises InputError."""
    _check(values)
    plot = plotter(values.plot, "covariance_plot")
    depth_sigma = _depth_sigma(values.drive, values.disparity_sigma)
    pairs, counts = read_pairs(values.runs, values.lidar, values.stereo, values.tracks, values.pose)
    table = covariance_table(
        pairs, values.bin_width, values.range, values.min_pairs, values.with_bias
    )
    print(summary(table, counts))
    text = as_yaml(table, values.source, values.runs)
    write_file(values.out, text)
    if plot is not None:
        write_file(values.plot, plot(table, depth_sigma))
    command_line.write_json(values.json, as_dictionary(table, counts))


def add_arguments(parser):
    """Adds the arguments of this subcommand."""
    add = parser.add_argument
    add("runs", nargs="+", type=Path, metavar="RUN.bag", help="bags of run_bag --object-fusion")
    add_table(parser, "object_covariance.yaml")
    add("--plot", type=command_line.output_file, metavar="FILE",
        help="picture of it: .svg, .pdf or .png")  # fmt: skip
    add("--drive", type=Path, metavar="DRIVE.bag",
        help="with the camera's calibration: the plot shows what theory expects too")  # fmt: skip
    add("--source", default="stereo", help="name in object_fusion/sources (default %(default)s)")
    for name, topic in TOPICS.items():
        add(f"--{name}", default=topic, metavar="TOPIC", help="(default %(default)s)")
    add("--min-pairs", type=command_line.count, default=MIN_PAIRS, metavar="N",
        help="pairs for a bin to be measured (default %(default)s)")  # fmt: skip
    add("--with-bias", action="store_true", help="variance about zero, not about the mean")
    command_line.add_number(parser, "--bin-width", BIN_WIDTH, "M", "m")
    command_line.add_number(parser, "--range", RANGE, "M", "upper end of the bins, m")
    command_line.add_number(parser, "--disparity-sigma", DISPARITY_SIGMA, "PX",
                            "standard deviation of disparities for --drive, px")  # fmt: skip
    command_line.add_json(parser)
