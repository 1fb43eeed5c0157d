# SPDX-License-Identifier: BSD-3-Clause
"""Finds and runs the package's programs that its Python tools call."""

import os
import shutil
import signal
import subprocess
from pathlib import Path

from datmo_tools.errors import InputError


class StepFailed(Exception):
    """A program failed: which one, and the last line of its error output."""

    def __init__(self, step, said, code=1):
        """code: exit code; negative: the signal that ended it."""
        self.code = code
        lines = said.strip().splitlines()
        if code < 0:
            super().__init__(f"{step}: ended by signal {-code} ({signal.strsignal(-code)})")
        else:
            super().__init__(lines[-1] if lines else f"{step}: failed without a message")


def find(name, tool):
    """Returns the path (str) of a program of the package that the file `tool` calls.

    Searches the folder of the tool (devel space and installed tree have both in one folder), the
    sourced workspaces by CMAKE_PREFIX_PATH (for a tool that runs from the source tree), and PATH.
    Raises InputError if it is not found.
    """
    prefixes = filter(None, os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep))
    folders = [Path(tool).parent, *(Path(p) / "lib" / "datmo_fusion" for p in prefixes)]
    search_path = os.pathsep.join([*map(str, folders), os.environ.get("PATH", os.defpath)])
    found = shutil.which(name, path=search_path)
    if found is None:
        raise InputError(
            f"{name} is not beside {tool}, in no sourced workspace and not on PATH;"
            " build it, and source setup.bash of the devel space or of the installed tree"
        )
    return found


def settings(assignments, option="--set"):
    """Returns the words of a command line that give each assignment (KEY=VALUE) to an option."""
    return [word for assignment in assignments for word in (option, assignment)]


def check(folder, names):
    """Raises InputError unless the programs are in the folder (Path)."""
    for name in names:
        if not (folder / name).is_file():
            raise InputError(f"{folder / name}: no such program, expected the built {name}")


def call(program, *words):
    """Runs a program (Path) to its end, without output. Raises StepFailed, also without it."""
    _run(program, words, subprocess.DEVNULL)


def output_of(program, *words):
    """Like call(), but returns the program's output as text."""
    return _run(program, words, subprocess.PIPE).stdout


def _run(program, words, stdout):
    try:
        done = subprocess.run(
            [str(program), *map(str, words)],
            stdout=stdout,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
            check=False,
            env={**os.environ, "LC_ALL": "C"},  # texts of the system, which callers search, in English
        )
    except OSError as error:
        raise StepFailed(program.name, f"{program}: cannot be run: {error.strerror}") from error
    if done.returncode != 0:
        raise StepFailed(program.name, done.stderr, done.returncode)
    return done
