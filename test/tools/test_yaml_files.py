#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Yaml files from outside: read within bounds, or refused with one line."""

import tempfile
import unittest
from pathlib import Path

from datmo_tools.errors import InputError
from datmo_tools.yaml_files import load_yaml, parse_yaml

LEVELS = 27


class YamlFiles(unittest.TestCase):
    def refused(self, text, said):
        with self.assertRaises(InputError) as caught:
            parse_yaml("a.yaml", text)
        self.assertEqual(str(caught.exception), f"a.yaml{said}")

    def test_contents(self):
        self.assertEqual(parse_yaml("a", "a: &a [1, 2]\nb: *a\nc: [*a, *a]"),
                         {"a": [1, 2], "b": [1, 2], "c": [[1, 2], [1, 2]]})  # fmt: skip
        self.assertIsNone(parse_yaml("a", ""))

    def test_a_recursive_alias(self):
        said = ":2: expected yaml, but an alias stands for what it stands in"
        self.refused("b: 1\na: &a [*a]", said)
        self.refused("b: 1\na: &a {b: {c: *a}}", said)

    def test_excessive_aliases(self):
        lines = ["a0: &a0 [1, 1]"]
        lines += [f"a{n}: &a{n} [*a{n - 1}, *a{n - 1}]" for n in range(1, LEVELS + 1)]
        self.refused("\n".join(lines),
                     ":15: expected yaml, but there are more than 100000 values, including those of aliases")  # fmt: skip

    def test_depth(self):
        self.refused("a: " + 20000 * "[", ":1: expected yaml, but lists and maps are nested more than 100 deep")
        self.assertEqual(len(parse_yaml("a", 90 * "[" + 90 * "]")), 1)

    def test_values_that_contradict_their_tags(self):
        for value in ("!!bool x", "!!int ''", "!!timestamp x", "!!float ''", f"!!float {'1:' * 300}1"):
            with self.subTest(value), self.assertRaisesRegex(InputError, "a.yaml: expected yaml, but a value is not"):
                parse_yaml("a.yaml", f"a: {value}")

    def test_numbers_are_short(self):
        long = "1:" * 10000 + "1"
        for value in (long, f"!!int '{long}'", f"!!int {{=: '{long}'}}", f"{long}.5"):
            with self.subTest(value[:20]), self.assertRaisesRegex(InputError, "a number has more than 1000 characters"):
                parse_yaml("a.yaml", f"a: {value}")
        self.assertEqual(parse_yaml("a", f"a: 1:30:00\nb: {'f0' * 5000}\nc: 0.5"), {"a": 5400, "b": "f0" * 5000, "c": 0.5})

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "a.yaml"
            for content in (b"a: 1 #" + 2_000_000 * b" ", b"a: \xff\xfe", b"a: [", b"a: *b", b"a: 2026-99-99"):
                file.write_bytes(content)
                with self.assertRaisesRegex(InputError, f"{file}.*expected yaml, but"):
                    load_yaml(file)
            for other in (folder, file.with_name("none"), "/dev/zero"):
                with self.assertRaisesRegex(InputError, f"{other}"):
                    load_yaml(other)


if __name__ == "__main__":
    unittest.main()
