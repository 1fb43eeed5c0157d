# SPDX-License-Identifier: BSD-3-Clause
"""The launch files as roslaunch loads them, for tests that load them dozens of times."""

import functools
import os
from pathlib import Path
from unittest import mock

import roslaunch.config
from roslaunch.xmlloader import XmlLoader

PACKAGE = Path(__file__).resolve().parents[2]


@functools.lru_cache(maxsize=None)
def _answer(command, name):
    return XmlLoader().param_value(False, name, "auto", None, None, None, command)


class _Loader(XmlLoader):
    """Runs a command of a parameter only once: starting it takes longer than all the rest."""

    def param_value(self, verbose, name, ptype, value, textfile, binfile, command):
        if command is None or ptype != "auto":
            return super().param_value(verbose, name, ptype, value, textfile, binfile, command)
        return _answer(command, name)


def load(file, words):
    """Returns roslaunch's configuration of a file of launch/ with arguments such as
    "risk:=true"."""
    path = f"{PACKAGE}:{os.environ.get('ROS_PACKAGE_PATH', '')}"
    with mock.patch.dict(os.environ, ROS_PACKAGE_PATH=path):
        return roslaunch.config.load_config_default(
            [(str(PACKAGE / "launch" / file), words)], None, loader=_Loader())
