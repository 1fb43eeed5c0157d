#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""config/thesis.yaml has the value of each parameter of which doc/parameters.md says what the thesis's is."""

import math
import re
import unittest
from pathlib import Path

import yaml

PACKAGE = Path(__file__).resolve().parents[2]

# Of no stage of the thesis's; what its method of borders does not use.
NOT_OF_THE_THESIS = (("loop_closing", ""), ("road_border", "side_streets/"))

VALUE_IN_PARENTHESES = re.compile(r"\(thesis[^():;]*: (-?[\d.]+)[);]|\((-?[\w./]+): thesis\)")
VALUE_BEFORE = re.compile(r"(?:^|; )([\w./]+): [^;|]*\(thesis[^)]*\)")


def value_of(text, allowed):
    """A value as the page writes it; None for what is none of this parameter's."""
    if text == "pi/2":
        return math.pi / 2
    if text in ("true", "false"):
        return text == "true"
    if text in allowed.split(", "):
        return text
    try:
        return float(text)
    except ValueError:
        return None


def thesis_values(page):
    """(section, key, value by default, the thesis's value) of the rows that have one."""
    section = None
    for line in page.splitlines():
        if line.startswith("#"):
            heading = re.match(r"#+ `(\w+)`", line)
            section = heading and heading.group(1)
        if not line.startswith("| `"):
            continue
        key, _, default, allowed, description = (cell.strip("`|' ") for cell in line.split(" | ", 4))
        said = [a or b for a, b in VALUE_IN_PARENTHESES.findall(description)] + VALUE_BEFORE.findall(description)
        for value in (value_of(text, allowed) for text in said):
            if value is not None and not any(section == s and key.startswith(k) for s, k in NOT_OF_THE_THESIS):
                yield section, key, value_of(default, allowed), value


def preset_value(preset, section, key):
    value = preset.get(section, {})
    for part in key.split("/"):
        value = value.get(part) if isinstance(value, dict) else None
    return value


class ThesisPreset(unittest.TestCase):
    def test_has_the_values_that_the_parameters_page_calls_the_thesiss(self):
        preset = yaml.safe_load((PACKAGE / "config/thesis.yaml").read_text(encoding="utf-8"))
        rows = list(thesis_values((PACKAGE / "doc/parameters.md").read_text(encoding="utf-8")))
        self.assertGreater(len(rows), 30)
        for section, key, default, expected in rows:
            said = preset_value(preset, section, key)
            with self.subTest(section=section, key=key):
                value = default if said is None else said
                if isinstance(expected, float):
                    self.assertAlmostEqual(float(value), expected, places=3)
                else:
                    self.assertEqual(value, expected)


if __name__ == "__main__":
    unittest.main()
