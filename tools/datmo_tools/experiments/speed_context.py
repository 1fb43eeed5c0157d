# SPDX-License-Identifier: BSD-3-Clause
"""Describes the origin of figures: the code, the compiler and the machine."""

import datetime
import os
import subprocess
from pathlib import Path

from datmo_tools.errors import InputError


def describe(source, build):
    """Returns the context of what is built from the folder `source` in the folder `build` (Paths).

    Raises InputError if nothing is built.
    """
    cache = _cache_of(build)
    return {
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "commit": _commit(source),
        "machine": f"{_processor(Path('/proc/cpuinfo').read_text())} x {os.cpu_count()}",
        "compiler": _first_line([cache["CMAKE_CXX_COMPILER"], "--version"]),
        "build_type": cache["CMAKE_BUILD_TYPE"],
        "load_average": os.getloadavg()[0],  # of the minute before: other load
    }


def devel_space(build):
    """Returns where the folder `build` (Path) puts programs (Path). Raises InputError."""
    return Path(_cache_of(build).get("CATKIN_DEVEL_PREFIX", build / "devel"))


def _cache_of(build):
    cache_file = build / "CMakeCache.txt"
    try:
        return cmake_cache(cache_file.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{cache_file}: expected a build folder ({error})") from error


def cmake_cache(text):
    """Returns name -> value of a CMakeCache.txt."""
    entries = {}
    for line in text.splitlines():
        name, equals, value = line.partition("=")
        if equals and not line.startswith(("#", "//")):
            entries[name.partition(":")[0]] = value
    return entries


def _commit(source):
    """Returns the short hash, with a suffix if the tree differs from the commit."""
    return _first_line(["git", "-C", str(source), "describe", "--always", "--dirty"])


def _processor(cpuinfo):
    names = [
        line.partition(":")[2] for line in cpuinfo.splitlines() if line.startswith("model name")
    ]
    return names[0].strip() if names else "unknown processor"


def _first_line(command):
    """Returns a command's output; "unknown" if it fails or does not exist (no git, no git tree)."""
    try:
        done = subprocess.run(command, check=False, capture_output=True, encoding="utf-8")
    except OSError:
        return "unknown"
    lines = done.stdout.splitlines()
    return lines[0] if done.returncode == 0 and lines else "unknown"
