# SPDX-License-Identifier: BSD-3-Clause
"""What the tools' command lines share: exit codes, and options that are numbers or paths."""

import argparse
import io
import json
import math
import signal
import sys
from pathlib import Path

from datmo_tools.errors import InputError
from datmo_tools.whole_files import check_folder, write_file


def run(name, work, product="bag"):
    """Calls `work()`, which writes a `product`; returns the exit code of the tool `name`.

    An InputError or an interruption prints one line to standard error and returns 1. SIGTERM is
    handled like Ctrl-C, so that `work` can clean up. A file's name that is not UTF-8 is printed as the
    bytes that it is.
    """
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="surrogateescape")
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
    """Returns an argparse.ArgumentParser whose help keeps the description's line breaks."""
    return argparse.ArgumentParser(
        prog=program,
        description=description,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def add_number(group, name, default, metavar, description):
    """Adds an option with one number, or with as many as the default (a list) has."""
    group.add_argument(
        name,
        type=number,
        nargs=len(default) if isinstance(default, list) else None,
        default=default,
        metavar=metavar,
        help=f"{description} (default %(default)s)",
    )


def check_positive(values, *names):
    """Raises InputError unless these options, by their argparse names, are greater than 0."""
    _check(values, names, lambda value: value > 0.0, "more than 0")


def check_not_negative(values, *names):
    """Like that, of options that may be 0."""
    _check(values, names, lambda value: value >= 0.0, "0 or more")


def _check(values, names, is_valid, expected):
    for name in names:
        value = getattr(values, name)
        if not is_valid(value):
            raise InputError(f"--{name.replace('_', '-')} is {value:g}, expected {expected}")


def add_json(parser):
    """Adds the option --json, for write_json()."""
    help_text = "also write the score to this file"
    parser.add_argument("--json", type=output_file, metavar="FILE", help=help_text)


def write_json(path, result):
    """Writes a dictionary to the file (Path) that an option names; does nothing for None."""
    if path is not None:
        write_file(path, json.dumps(result, indent=2) + "\n")


def output_file(text):
    """Returns the Path of a writable output file; otherwise argparse reports the option at once."""
    path = Path(text)
    if path.is_dir():
        raise argparse.ArgumentTypeError(f"{path}: is a folder, expected the name of a file")
    output_folder(path.parent)
    return path


def output_folder(text):
    """Returns the Path of a folder that can be written or created; else argparse reports it."""
    path = Path(text)
    try:
        check_folder(path)
    except InputError as error:
        raise argparse.ArgumentTypeError(str(error)) from error
    return path


def count(text):
    """Returns a whole number of 1 or more; otherwise argparse reports the option."""
    if not (text.isascii() and text.isdigit() and int(text) > 0):
        raise argparse.ArgumentTypeError(f"'{text}', expected a whole number of 1 or more")
    return int(text)


def number(text):
    """Returns a finite number; otherwise argparse reports the option."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"'{text}', expected a finite number")
    return value
