# SPDX-License-Identifier: BSD-3-Clause
"""Creates an rviz configuration from the shipped one: for one of several vehicles on one master,
with prefixed frames and namespaced topics; with other panels shown."""

import copy
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


def view_with_panels(view, shown):
    """Returns a view whose displays with a panel (images) are shown or hidden: `shown`, by name.

    The state of Qt's window, in which a panel's name is followed by a byte, takes precedence over
    the display. Raises InputError for a name without a panel.
    """
    view = copy.deepcopy(view)
    displays = {each.get("Name"): each for each in view["Visualization Manager"]["Displays"]}
    geometry = view["Window Geometry"]
    for name, is_shown in shown.items():
        state = bytes.fromhex(str(geometry["QMainWindow State"]))
        before, encoded, after = state.partition(name.encode("utf-16-be"))
        if name not in displays or not encoded:
            raise InputError(f"'{name}': no panel of the view, expected the name of a display of images")
        displays[name]["Enabled"] = is_shown
        geometry["QMainWindow State"] = (before + encoded + bytes([is_shown]) + after[1:]).hex()
    return view


def write_view(file, prefix, namespace, folder, shown):
    """Writes a view for a vehicle into a folder, which is created if needed; returns its path.
    `shown`: as for view_with_panels.

    Each vehicle has one such file, which its next start replaces. Raises InputError.
    """
    view = load_yaml(file)
    if not isinstance(view, dict):
        raise InputError(f"{file}: expected an rviz configuration")
    vehicle = dict.fromkeys(word for word in f"{namespace}/{prefix}".split("/") if word)
    name = "_".join([Path(file).stem, *vehicle]) + ".rviz"
    text = yaml.safe_dump(view_of_vehicle(view_with_panels(view, shown), prefix, namespace), sort_keys=False)
    write_whole(Path(folder), {name: text})
    return str(Path(folder, name))
