# SPDX-License-Identifier: BSD-3-Clause
"""Tests that call evaluate in their own folder."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

from datmo_tools.evaluate.main import main


class EvaluateCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def evaluate(self, subcommand, *words, code=0):
        """Returns standard output, standard error, and the JSON that it writes (None: it fails)."""
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            found = main([subcommand, *map(str, words), "--out", str(self.folder)])
        self.assertEqual(found, code, errors.getvalue())
        file = self.folder / f"{subcommand}.json"
        return out.getvalue(), errors.getvalue(), None if code else json.loads(file.read_text())
