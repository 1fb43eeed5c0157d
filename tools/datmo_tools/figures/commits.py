# SPDX-License-Identifier: BSD-3-Clause
"""The commit at which figures are measured, and what has changed since an earlier one."""

import re
import subprocess

from datmo_tools.errors import InputError
from datmo_tools.figures.effects import without_effect

CHANGED = "-changed"  # suffix of a commit's name if the sources have been changed since
NAME = re.compile(r"[0-9a-f]{7,40}")


def commit_of(source):
    """Returns the abbreviated last commit in a checkout (Path) that changed what figures depend on.
    Raises InputError."""
    files = (".", *(f":(exclude){prefix}*" for prefix in without_effect()))
    name = _git(source, "log", "-1", "--abbrev=8", "--format=%h", "--", *files).strip()
    changes = _git(source, "status", "--porcelain", "--", *files)
    return name + (CHANGED if changes else "")


def changed_files(source, earlier):
    """Returns the files that differ between a commit and the one that is checked out; None if it is
    not known to be an ancestor of that one."""
    if not NAME.fullmatch(earlier):
        return None
    if _run(source, "merge-base", "--is-ancestor", earlier, "HEAD").returncode != 0:
        return None
    # Without renames: both names of a file count.
    names = _git(source, "diff-tree", "-r", "--name-only", "--no-renames", "-z", earlier, "HEAD")
    return names.split("\0")[:-1]


def _git(source, *words):
    done = _run(source, *words)
    if done.returncode != 0:
        raise InputError(f"{source}: no git commit, expected a git checkout: {done.stderr}")
    return done.stdout


def _run(source, *words):
    return subprocess.run(["git", "-C", str(source), *words], check=False, capture_output=True,
                          encoding="utf-8")  # fmt: skip
