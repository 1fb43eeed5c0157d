# SPDX-License-Identifier: BSD-3-Clause
"""Command line of check_bag."""

import sys
from pathlib import Path

from datmo_tools import command_line
from datmo_tools.check_bag import report
from datmo_tools.check_bag.checks import check
from datmo_tools.check_bag.findings import Severity
from datmo_tools.check_bag.opening import open_recording
from datmo_tools.errors import InputError
from datmo_tools.text_table import one_line
from datmo_tools.whole_files import write_file

DESCRIPTION = """\
Reports what a recording contains, which problems it has for this package, and how to start.

Reads the bag without a master and reports: what is missing for each level of fusion; rates, gaps
and order of stamps; clock offsets between the scanner and odometry or IMU, and scale and sign of
these, from the motion estimated from the scans; frames and mounts; beams that are dead or hit the
vehicle itself; range compared with the window; calibration of cameras. Then it writes an initial
yaml with the values that differ from the defaults, and prints the commands to start the stack.

Exit code: 0 nothing worse than a warning, 1 errors, or the yaml exists or cannot be written, 2 the
bag cannot be read."""

UNREADABLE = 2


def main(arguments=None):
    """Runs the command line; returns its exit code."""
    values = _parser().parse_args(arguments)
    codes = []
    code = command_line.run("check_bag", lambda: codes.append(_run(values)), product="report")
    return code or codes[0]


def _parser():
    parser = command_line.new_parser("check_bag", DESCRIPTION)
    add = parser.add_argument
    add("bag", type=Path, help="recorded bag")
    add("--out", type=Path, metavar="FILE.yaml",
        help="yaml to write (default: the bag's name, .yaml, in the working folder)")  # fmt: skip
    add("--force", action="store_true", help="overwrite the yaml if it exists")
    add("--no-yaml", action="store_true", help="do not write a yaml")
    add("--scan", metavar="TOPIC", help="scanner to use (default: /scan, or the most messages)")
    add("--odometry", metavar="TOPIC", help="odometry to use (default: /odometry, or the most messages)")
    command_line.add_json(parser)
    return parser


def _run(values):
    try:
        recording = open_recording(values.bag)
    except InputError as error:
        print(f"check_bag: {error}", file=sys.stderr)
        return UNREADABLE
    out = values.out or Path(values.bag.resolve().stem + ".yaml")
    if not values.no_yaml:
        _check_output(values.bag, out, values.force)
    result = check(recording, values.scan, values.odometry)
    _print(recording, result)
    if not values.no_yaml and result.can_start:
        write_file(out, result.yaml_text())
        print(f"\nInitial parameters: {one_line(str(out))}\nTo start:")
        print("\n".join(f"  {line}" for line in result.start_lines(values.bag, out)))
    command_line.write_json(values.json, result.as_dictionary())
    return 1 if result.findings.worst() == Severity.ERROR else 0


def _check_output(bag, out, force):
    """Raises InputError if writing the yaml would replace the bag, or an existing file without
    --force."""
    if out.exists() and out.samefile(bag):
        raise InputError(f"{out}: is the bag itself, expected another name of the yaml: --out FILE.yaml")
    if out.exists() and not force:
        raise InputError(
            f"{out}: exists, expected the name of a new file; to overwrite it: --force, to leave it"
            " as it is: --no-yaml"
        )


def _print(recording, result):
    print(f"{one_line(str(recording.path))}: {recording.duration:.1f} s\n")
    print(report.topics_text(recording))
    print("\nLevels")
    print(report.levels_text(result.levels))
    print("\nMeasured")
    print(report.measured_text(result.facts, result.measured, result.mount, result.results))
    print("\nFindings")
    print(report.findings_text(result.findings))
