# SPDX-License-Identifier: BSD-3-Clause
"""Command blocks of Markdown pages: which are run as written, which are left out, and why."""

import re
from dataclasses import dataclass, field

# Why a block cannot be run on every machine within seconds, by the word of its mark.
MARKS = {
    "build": "builds or installs",
    "display": "needs a screen",
    "download": "needs recordings that have to be downloaded",
    "hours": "takes more than a few minutes",
    "robot": "needs sensors that are running",
    "workspace": "needs another machine or workspace",
}
MARK = re.compile(r"\s*<!--\s*needs:\s*(.*?)\s*-->\s*$")
FENCE = re.compile(r"(\s*)(`{3,}|~{3,})\s*(\S*)\s*$")
COMMAND = re.compile(r"\s+(\$ )?(rosrun|roslaunch|scripts/\w+|cmake|catkin|source)\s")


class PageError(Exception):
    """An error in a page, with its line."""


@dataclass
class Block:
    """One fenced block. `needs` is a word of MARKS or empty,
    `files` are the files of a download."""

    line: int
    language: str
    lines: list = field(default_factory=list)
    needs: str = ""
    files: list = field(default_factory=list)

    @property
    def text(self):
        return "\n".join(self.lines) + "\n"


def parse_mark(words, line):
    """Returns (needs, files) of a mark's words; raises PageError if it is not one of MARKS."""
    if not words or words[0] not in MARKS:
        expected = ", ".join(MARKS)
        raise PageError(f"line {line}: needs '{' '.join(words)}': expected one of {expected}")
    if words[1:] and words[0] != "download":
        raise PageError(f"line {line}: '{' '.join(words[1:])}': only a download names files")
    return words[0], words[1:]


def _unindent(text, indent):
    return text[len(indent):] if text.startswith(indent) else text.lstrip()


class _Reader:
    """Parses a page line by line."""

    def __init__(self):
        self.blocks = []
        self.open = None  # (block, its indentation, its fence)
        self.mark = None  # (needs, files, line) that waits for its block

    def inside(self, text):
        block, indent, fence = self.open
        if text.strip() == fence:
            self.blocks.append(block)
            self.open = None
        else:
            block.lines.append(_unindent(text, indent))

    def begin(self, fence, line):
        block = Block(line, fence.group(3))
        if self.mark:
            if block.language != "bash":
                raise PageError(f"line {self.mark[2]}: the mark is not followed by a block of bash")
            block.needs, block.files, _ = self.mark
            self.mark = None
        self.open = (block, fence.group(1), fence.group(2))

    def outside(self, text, line):
        mark, fence = MARK.match(text), FENCE.match(text)
        if fence:
            self.begin(fence, line)
        elif self.mark and text.strip():
            raise PageError(f"line {self.mark[2]}: the mark is not followed by a block of bash")
        elif mark:
            self.mark = (*parse_mark(mark.group(1).split(), line), line)
        elif COMMAND.match(text):
            raise PageError(f"line {line}: a command outside of a fenced block: {text.strip()}")


def blocks_of(text):
    """Returns all fenced blocks of a page, in order.

    Throws PageError for an unknown mark, a mark without a block of bash right behind it, a fence
    that does not end, and for commands in an indented block, which nobody would run.
    """
    reader = _Reader()
    for line, content in enumerate(text.splitlines(), start=1):
        if reader.open:
            reader.inside(content)
        else:
            reader.outside(content, line)
    if reader.open:
        raise PageError(f"line {reader.open[0].line}: the block does not end")
    if reader.mark:
        raise PageError(f"line {reader.mark[2]}: the mark is not followed by a block of bash")
    return reader.blocks
