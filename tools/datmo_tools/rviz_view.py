# SPDX-License-Identifier: BSD-3-Clause
"""Creates an rviz configuration for one of several vehicles on one master: prefixed frames,
namespaced topics."""

from pathlib import Path

import yaml

from datmo_tools.errors import InputError
from datmo_tools.whole_files import write_whole
from datmo_tools.yaml_files import load_yaml

FRAME_KEYS = ("Fixed Frame", "Target Frame", "Reference Frame")
# rviz's name for the fixed frame, whatever it is.
SAME_AS_FIXED = "<Fixed Frame>"


def _changed(key, value, prefix, namespace):
    if isinstance(value, dict):
        return {name: _changed(name, each, prefix, namespace) for name, each in value.items()}
    if isinstance(value, list):
        return [_changed(key, each, prefix, namespace) for each in value]
    if key in FRAME_KEYS and value and value != SAME_AS_FIXED:
        return prefix + value
    if str(key).endswith("Topic") and isinstance(value, str) and value.startswith("/"):
        return namespace.rstrip("/") + value
    return value


def view_of_vehicle(view, prefix, namespace):
    """Returns a view, read from yaml, with `prefix` ("car1/") on frames, topics in `namespace`."""
    return _changed("", view, prefix, namespace)


def write_view(file, prefix, namespace, folder):
    """Writes a view for a vehicle into a folder, which is created if needed; returns its path.

    Each vehicle has one such file, which its next start replaces. Raises InputError.
    """
    view = load_yaml(file)
    if not isinstance(view, dict):
        raise InputError(f"{file}: expected an rviz configuration")
    vehicle = dict.fromkeys(word for word in f"{namespace}/{prefix}".split("/") if word)
    name = "_".join([Path(file).stem, *vehicle]) + ".rviz"
    text = yaml.safe_dump(view_of_vehicle(view, prefix, namespace), sort_keys=False)
    write_whole(Path(folder), {name: text})
    return str(Path(folder, name))
