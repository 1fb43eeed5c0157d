#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""config/thesis.yaml has the thesis's value of each parameter for which doc/parameters.md gives
one."""

import math
import re
import unittest
from pathlib import Path

import yaml

PACKAGE = Path(__file__).resolve().parents[2]

# Belongs to no stage of the thesis; not used by its method of road borders.
NOT_OF_THE_THESIS = (("loop_closing", ""), ("road_border", "side_streets/"))

# Modes and switches whose description names the thesis without its value, and where the thesis has
# it.
MODES = {
    "grid_fusion/rule": "weighted_sum", "grid_slam/grid_ends": "cells", "mono_grid/color/components": 1,
    "road_border/search/score": "hits", "road_border/search/take": "highest",
    "object_fusion/association": "nearest_neighbor",
    "tracker/require_motion": False, "tracker/target/filter/transitions/standing": False,
    "stereo_tracker/require_motion": False, "stereo_tracker/target/filter/transitions/standing": False,
    "track_fusion/scheme": "fused_plus_fallback", "track_fusion/association/test": "parallel",
    "mono_classifier/method": "thesis", "risk/method": "thesis",
}  # fmt: skip

VALUE_IN_PARENTHESES = re.compile(r"\(thesis[^():;]*: (-?[\d.]+)[);,]|\((-?[\w./]+): thesis\)")
VALUE_BEFORE = re.compile(r"(?:^|; )([\w./]+): [^;|]*\(thesis[^)]*\)")


def value_of(text, allowed):
    """Returns a value as the page writes it; None if it is no value of this parameter."""
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
    """Yields (section, key, default value, the thesis's value) of the rows that have one."""
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


def leaves(node, name=""):
    """Returns each value of nested sections by its full key."""
    if not isinstance(node, dict):
        return {name: node}
    return {key: value for part, inner in node.items() for key, value in leaves(inner, f"{name}/{part}").items()}


class ThesisPreset(unittest.TestCase):
    def test_has_the_values_that_the_parameters_page_calls_the_thesiss(self):
        preset = yaml.safe_load((PACKAGE / "config/thesis.yaml").read_text(encoding="utf-8"))
        preset = {key.lstrip("/"): value for key, value in leaves(preset).items()}
        rows = list(thesis_values((PACKAGE / "doc/parameters.md").read_text(encoding="utf-8")))
        self.assertEqual({key: preset.get(key) for key in MODES}, MODES)
        self.assertEqual(set(preset) - set(MODES) - {f"{section}/{key}" for section, key, _, _ in rows}, set())
        for section, key, default, expected in rows:
            with self.subTest(section=section, key=key):
                value = preset.get(f"{section}/{key}", default)
                if isinstance(expected, float):
                    self.assertAlmostEqual(float(value), expected, places=3)
                else:
                    self.assertEqual(value, expected)


if __name__ == "__main__":
    unittest.main()
