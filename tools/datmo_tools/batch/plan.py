# SPDX-License-Identifier: BSD-3-Clause
"""Finds the recordings of a batch, and the settings for processing each."""

import hashlib
import json
import re
import sys
from pathlib import Path
from typing import NamedTuple, Optional

from datmo_tools.errors import InputError
from datmo_tools.whole_files import write_whole

FORMAT = 1  # of plan and settings
TRUTH = ".truth.bag"  # suffix of a ground truth bag next to its recording
DIGEST = 8  # hexadecimal digits that distinguish recordings of the same name
UNSAFE = re.compile(r"[^A-Za-z0-9._-]+")


class Recording(NamedTuple):
    """One bag of the folder."""

    id: str  # names its files; unique in the folder
    name: str  # the bag, relative to the folder
    bag: Path
    truth: Optional[Path]  # a bag next to it
    config: Path  # the sensor set


def find_recordings(folder, out, config):
    """Returns a sorted list of Recording below `folder` (Path), without those in `out` (Path).

    config: sensor set (Path) of the recordings without one of their own, or None.
    """
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder, expected one with recordings (*.bag)")
    bags = sorted(bag for bag in folder.rglob("*.bag")
                  if not bag.name.endswith(TRUTH) and out.resolve() not in bag.resolve().parents
                  and not any((parent / "plan.json").is_file() for parent in bag.parents))
    if not bags:
        raise InputError(f"{folder}: no recordings, expected *.bag in it or below it")
    return [_recording(bag, folder, config) for bag in bags]


def _recording(bag, folder, config):
    name = str(bag.relative_to(folder))
    digest = hashlib.sha1(name.encode()).hexdigest()[:DIGEST]
    own = bag.with_suffix(".yaml")
    truth = bag.with_name(bag.stem + TRUTH)
    if not own.is_file() and config is None:
        raise InputError(f"{bag}: no sensor set, expected {own.name} next to it, or --config")
    return Recording(f"{UNSAFE.sub('_', bag.stem)}-{digest}", name, bag.resolve(),
                     truth.resolve() if truth.is_file() else None,
                     (own if own.is_file() else config).resolve())  # fmt: skip


def write_plan(out, recordings, programs, options, keep_bags):
    """Writes plan and settings to `out` (Path); unchanged settings keep their file.

    programs: folder (Path) of run_bag and score_run; options: further words (list) for run_bag.
    """
    common = {"format": FORMAT, "programs": str(programs.resolve()), "digest": digest_of(programs),
              "options": options, "keep_bags": keep_bags}  # fmt: skip
    for one in recordings:
        settings = {
            **common,
            **{key: value if value is None else str(value) for key, value in one._asdict().items()},
            "states": [_state(file) for file in (one.bag, one.truth, one.config)],
        }
        _write_if_new(out / "settings", f"{one.id}.json", json.dumps(settings, indent=1) + "\n")
    plan = {"format": FORMAT, "python": sys.executable, "recordings": [one.id for one in recordings]}
    write_whole(out, {"plan.json": json.dumps(plan, indent=1) + "\n"})


def digest_of(programs):
    """Returns a digest of what makes the results: the programs and their libraries."""
    libraries = sorted(programs.parent.glob("libdatmo_fusion*.so"))
    digest = hashlib.sha1()
    for file in (programs / "run_bag", programs / "score_run", *libraries):
        digest.update(file.read_bytes())
    return digest.hexdigest()


def _state(file):
    """Returns what identifies a changed file without reading it; None if it does not exist."""
    try:
        state = file.stat()
    except (AttributeError, OSError):
        return None
    return [state.st_size, state.st_mtime_ns]


def _write_if_new(folder, name, text):
    try:
        if (folder / name).read_text() == text:
            return
    except FileNotFoundError:
        pass
    write_whole(folder, {name: text})
