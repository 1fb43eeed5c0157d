# SPDX-License-Identifier: BSD-3-Clause
"""What the stereo camera of a sensor set sees, from its section stereo_camera."""

import re
from pathlib import Path
from typing import NamedTuple

from datmo_tools.errors import InputError
from datmo_tools.programs import StepFailed, output_of
from datmo_tools.yaml_files import load_yaml

LIST_PARAMETERS = "list_parameters"

_SECTION = "stereo_camera"
_FIELD_OF_VIEW = "field_of_view"  # rad, from left to right
_RANGE = "effective_range"  # m


class CameraView(NamedTuple):
    """A sector in front of the vehicle."""

    range: float  # m
    half_angle: float  # rad, to either side


def camera_view(config, programs):
    """Returns the CameraView of a sensor set.

    config: its yaml file (Path); parameters that it does not set have the defaults, which the
    program list_parameters in the folder `programs` (Path) prints. Raises InputError.
    """
    sections = load_yaml(config) or {}
    defaults = _defaults(Path(programs) / LIST_PARAMETERS)
    values = [_value(sections, name, defaults) for name in (_RANGE, _FIELD_OF_VIEW)]
    for name, value in zip((_RANGE, _FIELD_OF_VIEW), values):
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise InputError(f"{config}: {_SECTION}/{name} is {value!r}, expected a number")
    return CameraView(float(values[0]), 0.5 * float(values[1]))


def _value(sections, name, defaults):
    """Returns a parameter; that of the defaults if the sensor set does not have it."""
    section = sections.get(_SECTION) if isinstance(sections, dict) else None
    value = section.get(name) if isinstance(section, dict) else None
    return defaults[name] if value is None else value


def _defaults(program):
    """Returns a dictionary name -> default of the numbers among the section's parameters."""
    try:
        text = output_of(program)
    except (StepFailed, OSError) as error:
        raise InputError(f"{program}: {error}") from error
    section = re.search(rf"^## [^\n]*`{_SECTION}`.*?(?=^## |\Z)", text, re.DOTALL | re.MULTILINE)
    rows = re.findall(r"^\| `([^`]+)` \|[^|]*\| ([-+.\de]+) \|", section[0] if section else "",
                      re.MULTILINE)  # fmt: skip
    defaults = {name: float(value) for name, value in rows}
    for name in (_RANGE, _FIELD_OF_VIEW):
        if name not in defaults:
            raise InputError(f"{program}: no number for {name} of {_SECTION} in what it prints")
    return defaults
