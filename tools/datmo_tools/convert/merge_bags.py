# SPDX-License-Identifier: BSD-3-Clause
"""Command line of merge_bags."""

import contextlib
import heapq
from pathlib import Path

from datmo_tools import command_line
from datmo_tools.bag_file import whole_bag
from datmo_tools.bag_input import opened
from datmo_tools.errors import InputError

DESCRIPTION = """\
Merges several bags that were recorded together into one: the parts of 'rosbag record --split', or
one bag for each sensor. Messages are ordered by record time; they are not changed, and latched
topics stay latched."""


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    return command_line.run("merge_bags", lambda: merge(values.parts, values.bag))


def merge(parts, path):
    """Writes all messages of the bags `parts` (Paths) to the bag `path` (Path).

    Raises InputError, without leaving a bag: a part cannot be read, is given twice, or is the
    output bag.
    """
    files = [part.resolve() for part in parts]
    for part, file in zip(parts, files):
        if files.count(file) > 1:
            raise InputError(f"{part}: given twice, expected each part once")
        if file == path.resolve():
            raise InputError(f"{path}: the output must not be an input")
    with contextlib.ExitStack() as stack:
        bags = [stack.enter_context(opened(part)) for part in parts]
        output = stack.enter_context(whole_bag(path, "merge_bags"))
        messages = [bag.read_messages(raw=True, return_connection_header=True) for bag in bags]
        for message in heapq.merge(*messages, key=lambda message: message.timestamp):
            output.copy(message)


def _parser():
    parser = command_line.new_parser("merge_bags", DESCRIPTION)
    parser.add_argument("parts", nargs="+", type=Path, metavar="PART.bag", help="bags to read")
    parser.add_argument("bag", type=Path, metavar="ALL.bag", help="bag to write")
    return parser
