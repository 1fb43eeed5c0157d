#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""README.md and doc/: their links are valid, their yaml names existing parameters; the changelog is
valid reStructuredText."""

import io
import re
import sys
import unittest
from pathlib import Path

import yaml

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "test" / "documents"))

from command_blocks import blocks_of  # noqa: E402
from datmo_tools.evaluate.main import SUBCOMMANDS  # noqa: E402

PAGES = [SOURCE / "README.md", *sorted((SOURCE / "doc").glob("*.md"))]
LINKED_PAGES = [*PAGES, SOURCE / "rosbag_fixtures" / "README.md"]
CHANGELOG = SOURCE / "CHANGELOG.rst"
MAX_README_LINES = 200  # lines
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
# Groups of files that are read by one nodelet alone: can_signals of live.launch.
OWN_FILES = {"can": "device"}
# Names chosen by the examples, and placeholders in doc/parameters.md.
CHOSEN = {"/radar/": "/stereo/", "/laser/": "/<frame>/"}


def documented_parameters():
    """Returns all `section/key` of doc/parameters.md; a heading may name several sections."""
    names, sections = set(), []
    for line in (SOURCE / "doc" / "parameters.md").read_text().splitlines():
        if line.startswith("## "):
            sections = re.findall(r"`([\w/<>]+)`", line)
        elif row := re.match(r"\| `([^`]+)` \|", line):
            names.update(f"{section}/{row.group(1)}" for section in sections)
    return names


def anchors_of(text):
    """Returns the link targets of a page's headings: letters, digits, hyphens for spaces."""
    return {re.sub(r"[^\w -]", "", heading).strip().lower().replace(" ", "-")
            for heading in HEADING.findall(text)}  # fmt: skip


def documented_name(key):
    key = f"{OWN_FILES[key.split('/')[0]]}/{key}" if key.split("/")[0] in OWN_FILES else key
    for chosen, documented in CHOSEN.items():
        key = key.replace(chosen, documented)
    return key


def keys_of(tree, prefix=""):
    """Returns the paths of all values in nested mappings."""
    if not isinstance(tree, dict):
        return [prefix]
    start = f"{prefix}/" if prefix else ""
    return [key for name, value in tree.items() for key in keys_of(value, f"{start}{name}")]


@unittest.skipUnless(PAGES[0].exists(), "no README.md here")
class Documents(unittest.TestCase):
    def test_readme_is_short(self):
        self.assertLessEqual(len(PAGES[0].read_text().splitlines()), MAX_README_LINES)

    def test_local_links_lead_to_files_and_headings(self):
        for page in LINKED_PAGES:
            for link in LINK.findall(page.read_text()):
                if not link.startswith(("http://", "https://")):
                    file, _, anchor = link.partition("#")
                    target = page.parent / file if file else page
                    self.assertTrue(target.exists(), f"{page}: {link}")
                    if anchor:
                        self.assertIn(anchor, anchors_of(target.read_text()), f"{page}: {link}")

    def test_every_page_is_reached_from_readme(self):
        links = LINK.findall(PAGES[0].read_text())
        for page in PAGES[1:]:
            self.assertIn(f"doc/{page.name}", links)

    def test_yaml_names_parameters_that_there_are(self):
        parameters = documented_parameters()
        for page in LINKED_PAGES:
            for block in blocks_of(page.read_text()):
                if block.language == "yaml":
                    for key in keys_of(yaml.safe_load(block.text)):
                        known = documented_name(key) in parameters
                        self.assertTrue(known, f"{page}:{block.line}: {key}")

    def test_images_give_classes_with_a_network_alone(self):
        """The default detector of mono_classifier has no weights."""
        said = [*LINKED_PAGES, CHANGELOG, SOURCE / "launch" / "perception.launch"]
        items = [item for file in said for item in re.split(r"\n(?=\s*(?:[-*|<]|\d+\.)\s?)|\n\n", file.read_text())]
        claims = [item for item in items if re.search(r"mono:=true|``mono_classifier``|arg name=.mono.", item)
                  and re.search(r"class(es|ify|ifies)\b", item)]  # fmt: skip
        self.assertGreater(len(claims), 5)
        for claim in claims:
            self.assertIn("network", claim)

    def test_evaluation_names_every_subcommand(self):
        page = (SOURCE / "doc" / "evaluation.md").read_text()
        for name in SUBCOMMANDS:
            self.assertRegex(page, rf"`evaluate {name}[ `]")


class Changelog(unittest.TestCase):
    def test_it_is_sound(self):
        """rosdep and ROS's tools read it; a warning of docutils is an error here."""
        try:
            from docutils.core import publish_doctree
            from docutils.utils import Reporter
        except ImportError:
            self.skipTest("needs docutils, expected Debian's package python3-docutils")
        said = io.StringIO()
        settings = {"report_level": Reporter.WARNING_LEVEL, "halt_level": Reporter.SEVERE_LEVEL + 1,
                    "warning_stream": said}  # fmt: skip
        publish_doctree(CHANGELOG.read_text(encoding="utf-8"), str(CHANGELOG),
                        settings_overrides=settings)  # fmt: skip
        self.assertEqual(said.getvalue(), "")


if __name__ == "__main__":
    unittest.main()
