# SPDX-License-Identifier: BSD-3-Clause
"""Starts a tool, or says which Debian package the module that it lacks is in."""

import importlib
import sys

# Modules whose packages are not called after them.
PACKAGES = {"cv2": "python3-opencv"}


def run_tool(tool, module=None):
    """Calls main() of a module of datmo_tools; returns the exit code.

    module: its name, where it is not the tool's. A module that is not installed is named on standard
    error, in one line, with the code 1.
    """
    try:
        main = importlib.import_module(f"datmo_tools.{module or tool}").main
    except ModuleNotFoundError as error:
        print(f"{tool}: {missing(error.name)}", file=sys.stderr)
        return 1
    return main()


def missing(module):
    """What to do about a module (dotted name) that is not there."""
    package = module.split(".")[0]
    if package.startswith("datmo_"):
        return f"Python module {module} is not there, expected 'source devel/setup.bash' before"
    name = PACKAGES.get(package, f"python3-{package.replace('_', '-')}")
    return f"Python module {package} is not there, expected Debian's package {name}"
