#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Commands within the sentences and tables of README.md and doc/, such as `run_bag --risk` and
`mono:=true`: the program's --help names each of the options, a launch file of the package has each
of the arguments."""

import functools
import os
import re
import subprocess
import unittest
from pathlib import Path

from datmo_tools.launch_arguments import arguments_of

SOURCE = Path(__file__).resolve().parents[2]
PAGES = [SOURCE / "README.md", *sorted((SOURCE / "doc").glob("*.md")), SOURCE / "rosbag_fixtures" / "README.md"]
PROGRAMS = Path(os.environ.get("CMAKE_PREFIX_PATH", "devel").split(":")[0]) / "lib" / "datmo_fusion"
TIMEOUT = 120  # s for a program's help on a busy machine
FENCED = re.compile(r"^ *```.*?^ *```$", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`(?:rosrun datmo_fusion )?([a-z_0-9]+)( [^`]*)?`")
ASSIGNMENTS = re.compile(r"`(?!roslaunch (?!datmo_fusion))([^`\n]*:=[^`]*)`")  # not of other packages
ASSIGNED = re.compile(r"(?<!\w)([a-z]\w*):=")
# run_bag only: images, which launch files find by the camera's namespace.
IMAGES = {"left_image", "right_image", "left_camera_info", "right_camera_info"}
LAUNCH_FILE = re.compile(r"\b\w+\.launch\b")
OTHERS = {"cmake", "rosbag"}  # programs of other packages
OPTION = re.compile(r"(?<![\w-])--[a-z][\w-]*")


def inline_commands(text):
    """Yields (our program, its arguments, options) of the commands with options outside of fenced
    blocks."""
    for name, words in SPAN.findall(FENCED.sub("", text)):
        options = OPTION.findall(words)
        if options and name not in OTHERS:
            yield name, words.split(), options


@functools.lru_cache(maxsize=None)
def arguments_taken(file):
    """Returns the argument names of a file of launch/, including those that it passes on."""
    return arguments_of(SOURCE / "launch" / file, lambda name: name.replace("$(find datmo_fusion)", str(SOURCE)))


def unknown_arguments(words):
    """Names that are assigned to in a command and that the launch file in it does not take; without one, no launch
    file of the package, nor run_bag."""
    files = LAUNCH_FILE.findall(words) or [file.name for file in (SOURCE / "launch").glob("*.launch")]
    known = set().union(*map(arguments_taken, files), () if LAUNCH_FILE.search(words) else IMAGES)
    return [name for name in ASSIGNED.findall(words) if name not in known]


@functools.lru_cache(maxsize=None)
def help_of(*command):
    done = subprocess.run([str(PROGRAMS / command[0]), *command[1:], "--help"], text=True, timeout=TIMEOUT,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)  # fmt: skip
    return done.stdout


class InlineCommands(unittest.TestCase):
    def test_only_commands_with_options_count(self):
        text = "`run_bag --risk A`, `run_bag`, `nobody --else`\n```bash\nrun_bag `run_bag --x`\n```\n"
        self.assertEqual(list(inline_commands(text)),
                         [("run_bag", ["--risk", "A"], ["--risk"]), ("nobody", ["--else"], ["--else"])])
        self.assertEqual(list(inline_commands("`cmake --install build`")), [])

    def test_arguments_are_those_of_the_launch_file(self):
        for words, unknown in (("replay.launch bag:=a scan:=/b", []), ("perception.launch bag:=a scan:=/b", ["bag"]),
                               ("bag:=a scan:=/b left_image:=/c", []), ("mono:=true scam:=/b", ["scam"])):
            self.assertEqual(unknown_arguments(words), unknown, words)

    def test_their_options_exist(self):
        count = 0
        for page in PAGES:
            for name, words, options in inline_commands(page.read_text()):
                self.assertTrue((PROGRAMS / name).exists(), f"{page.name}: {name}: no program of ours")
                # evaluate's options are those of its subcommand.
                command = (name, words[0]) if name == "evaluate" else (name,)
                for option in options:
                    self.assertRegex(help_of(*command), rf"{option}(?![\w-])", f"{page.name}: {name} {' '.join(words)}")
                    count += 1
        self.assertGreater(count, 20)

    def test_their_arguments_exist(self):
        count = 0
        for page in PAGES:
            for words in ASSIGNMENTS.findall(FENCED.sub("", page.read_text())):
                self.assertEqual(unknown_arguments(words), [], f"{page.name}: {words}")
                count += len(ASSIGNED.findall(words))
        self.assertGreater(count, 20)


if __name__ == "__main__":
    unittest.main()
