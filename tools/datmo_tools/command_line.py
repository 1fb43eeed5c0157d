# SPDX-License-Identifier: BSD-3-Clause
"""What the command lines of the tools share: how they end, and options that are numbers."""

import argparse
import json
import math
import signal
import sys
from pathlib import Path

from datmo_tools.errors import InputError
from datmo_tools.whole_files import check_folder, write_whole


def run(name, work, product="bag"):
    """Calls `work()`, which writes a `product`; returns the exit code of the tool `name`.

    An InputError and an interruption end with one line on standard error and the code 1. A kill
    counts as Ctrl-C, so that `work` cleans up.
    """
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        work()
    except InputError as error:
        print(f"{name}: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(f"{name}: interrupted, no {product} written", file=sys.stderr)
        return 1
    return 0


def new_parser(program, description):
    """An argparse.ArgumentParser whose help has the description's own lines."""
    return argparse.ArgumentParser(
        prog=program,
        description=description,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def add_number(group, name, default, metavar, description):
    """An option of one number, or of as many as the default (a list) has."""
    group.add_argument(
        name,
        type=number,
        nargs=len(default) if isinstance(default, list) else None,
        default=default,
        metavar=metavar,
        help=f"{description} (default %(default)s)",
    )


def check_positive(values, *names):
    """Raises InputError unless these options, as argparse names them, are more than 0."""
    for name in names:
        value = getattr(values, name)
        if value <= 0.0:
            raise InputError(f"--{name.replace('_', '-')} is {value:g}, expected more than 0")


def add_json(parser):
    """The option --json, for write_json()."""
    help_text = "writes the score there too"
    parser.add_argument("--json", type=output_file, metavar="FILE", help=help_text)


def write_json(path, result):
    """Writes a dictionary to the file that --json names; nothing where it names none (None)."""
    if path is not None:
        write_whole(path.parent, {path.name: json.dumps(result, indent=2) + "\n"})


def output_file(text):
    """Path of a file that can be written; argparse names the option where it cannot, at once."""
    path = Path(text)
    if path.is_dir():
        raise argparse.ArgumentTypeError(f"{path}: is a folder, expected the name of a file")
    output_folder(path.parent)
    return path


def output_folder(text):
    """Path of a folder that can be written, or made; argparse names the option otherwise."""
    path = Path(text)
    try:
        check_folder(path)
    except InputError as error:
        raise argparse.ArgumentTypeError(str(error)) from error
    return path


def count(text):
    """A whole number of 1 or more; argparse names the option where it is none."""
    if not (text.isascii() and text.isdigit() and int(text) > 0):
        raise argparse.ArgumentTypeError(f"'{text}', expected a whole number of 1 or more")
    return int(text)


def number(text):
    """A finite number; argparse names the option where it is none."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"'{text}', expected a finite number")
    return value
