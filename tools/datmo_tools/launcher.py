# SPDX-License-Identifier: BSD-3-Clause
"""Starts a tool, or names the Debian package of a missing module."""

import importlib
import sys

# Modules whose packages are named differently.
PACKAGES = {"cv2": "python3-opencv"}


def run_tool(tool, module=None):
    """Calls main() of a module of datmo_tools; returns the exit code.

    module: its name if it differs from the tool's. A module that is not installed is reported in
    one line on standard error, with the exit code 1.
    """
    try:
        main = importlib.import_module(f"datmo_tools.{module or tool}").main
    except ModuleNotFoundError as error:
        print(f"{tool}: {missing(error.name)}", file=sys.stderr)
        return 1
    return main()


def missing(module):
    """Returns what to do about a missing module (dotted name)."""
    package = module.split(".")[0]
    if package.startswith("datmo_"):
        return f"Python module {module} not found, expected 'source devel/setup.bash' before"
    name = PACKAGES.get(package, f"python3-{package.replace('_', '-')}")
    return f"Python module {package} not found, expected Debian's package {name}"
