#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A devel space or an installed tree as its user has it: a fresh shell that sources its setup.bash.

DATMO_FUSION_SPACE: the folder of setup.bash. DATMO_FUSION_BUILD: where CMake has written what it
installs. An installed tree must not need the sources or the build: what comes from there fails.
"""

import os
import re
import subprocess
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SPACE = Path(os.environ["DATMO_FUSION_SPACE"])
BUILD = Path(os.environ["DATMO_FUSION_BUILD"])
SOURCE = Path(__file__).resolve().parents[2]
INSTALLED = not (SPACE / ".catkin").read_text()  # a devel space names its sources there
TIMEOUT = 600  # s for one command that hangs; on a busy machine one takes half a minute
INSTALL_RULE = re.compile(
    r'INSTALL DESTINATION "\$\{CMAKE_INSTALL_PREFIX\}/lib/datmo_fusion" TYPE (?:EXECUTABLE|PROGRAM)'
    r' FILES((?:\s+"[^"]+")+)'
)
LAUNCH_ARGUMENTS = {  # without which a file cannot be read
    "part.launch": ["part:=risk", "machine:=any"],
    "record.launch": ["bag:=none"],
    "replay.launch": ["bag:=none.bag"],
    "stereo_images.launch": ["images:=raw", "manager:=perception"],
}
# Libraries that a process has mapped, of this package.
LOAD_NODELETS = """
import ctypes
ctypes.CDLL("libdatmo_fusion_nodelets.so")
print(*{line.split()[-1] for line in open("/proc/self/maps") if "libdatmo_fusion" in line})
"""
IMPORT_PACKAGES = """
import datmo_fusion.msg, datmo_tools.evaluate.report
datmo_tools.evaluate.report.as_page("", [])
print(datmo_fusion.msg.__file__, datmo_tools.evaluate.__file__)
"""


def run(*words):
    """What the command prints in a shell that has sourced the space; its exit code."""
    environment = {"PATH": "/usr/local/bin:/usr/bin:/bin", "HOME": os.environ.get("HOME", "/")}
    # In a function, as setup.bash takes the arguments of its caller as its own.
    source = 'load() { . "$0/setup.bash"; }; load && exec "$@"'
    shell = ["bash", "-c", source, SPACE, *words]
    done = subprocess.run(
        shell, env=environment, cwd="/", timeout=TIMEOUT, check=False, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
    )  # fmt: skip
    return done.returncode, done.stdout


def installed_programs():
    """Returns the names of all programs that CMake's install rules put where rosrun looks."""
    rules = "\n".join(path.read_text() for path in BUILD.rglob("cmake_install.cmake"))
    files = (file for rule in INSTALL_RULE.findall(rules) for file in re.findall('"(.+?)"', rule))
    return sorted({Path(file).name for file in files})


class BuiltSpace(unittest.TestCase):
    def check(self, *words):
        code, output = run(*words)
        self.assertEqual(code, 0, f"{words}: {output}")
        if INSTALLED:
            self.assertNotIn(str(SOURCE), output)
        return output

    def test_rosrun_finds_every_program_that_is_installed(self):
        programs = installed_programs()
        self.assertLessEqual({"run_bag", "simulate", "score_run", "evaluate"}, set(programs))
        with ThreadPoolExecutor(2) as pool:
            done = pool.map(lambda name: run("rosrun", "datmo_fusion", name, "--help"), programs)
        for name, (code, output) in zip(programs, done):
            with self.subTest(program=name):
                self.assertEqual(code, 0, output)
                self.assertRegex(output.lower(), "usage|--benchmark_filter")

    def test_a_python_tool_finds_the_program_that_it_calls(self):
        """With a bag that does not exist: it is score_run that reports it."""
        code, output = run("rosrun", "datmo_fusion", "evaluate", "tracks", "none.bag", "--out", "none")
        self.assertNotEqual(code, 0)
        self.assertRegex(output, "score_run: .*none.bag")

    def test_launch_files_find_all_their_nodes(self):
        for file in sorted((SOURCE / "launch").glob("*.launch")):
            words = ["datmo_fusion", file.name, *LAUNCH_ARGUMENTS.get(file.name, [])]
            with self.subTest(file=file.name):
                self.check("roslaunch", "--files", *words)
                self.check("roslaunch", "--nodes", *words)

    def test_nodelets_load(self):
        output = self.check("/usr/bin/python3", "-c", LOAD_NODELETS)
        for path in output.split():
            self.assertTrue(Path(path).is_relative_to(SPACE.resolve()), path)

    def test_python_packages(self):
        output = self.check("/usr/bin/python3", "-c", IMPORT_PACKAGES)
        if INSTALLED:
            for path in output.split():
                self.assertTrue(Path(path).is_relative_to(SPACE), path)

    @unittest.skipUnless(INSTALLED, "a devel space uses the files of the sources")
    def test_files_beside_programs_are_installed(self):
        share = SPACE / "share" / "datmo_fusion"
        for folder in ("config", "launch", "meshes", "rosbag_fixtures"):
            names = {path.name for path in (SOURCE / folder).iterdir()}
            self.assertEqual({path.name for path in (share / folder).iterdir()}, names)
        self.assertTrue((share / "nodelets.xml").is_file())


if __name__ == "__main__":
    unittest.main()
