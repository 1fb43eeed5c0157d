#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""meshes/ is what scripts/meshes writes."""

import subprocess
import tempfile
import unittest
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2]
SCRIPT = PACKAGE / "scripts" / "meshes"


def contents(folder):
    """Returns the text of each file of a folder by name."""
    return {file.name: file.read_text(encoding="utf-8") for file in Path(folder).iterdir()}


class Meshes(unittest.TestCase):
    def test_the_files_are_what_the_script_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([SCRIPT, folder], check=True)
            self.assertEqual(contents(folder), contents(PACKAGE / "meshes"))

    def test_they_are_small(self):
        self.assertLess(sum(map(len, contents(PACKAGE / "meshes").values())), 30_000)

    def test_a_missing_folder_is_named(self):
        done = subprocess.run([SCRIPT, "/nowhere"], stderr=subprocess.PIPE, encoding="utf-8", check=False)
        self.assertEqual((done.returncode, done.stderr), (2, "meshes: no folder /nowhere\n"))


if __name__ == "__main__":
    unittest.main()
