# SPDX-License-Identifier: BSD-3-Clause
"""Loads matplotlib only for pictures that the command line asks for."""

import importlib

from datmo_tools.errors import InputError


def plotter(path, module, function):
    """Returns a function (data) -> bytes of a picture for the path; None for no path.

    module, function: of datmo_tools.evaluate, which draws: it gets the data and one of
    plot_style.KINDS, by the path's ending. Raises InputError for another ending, and without
    matplotlib.
    """
    if path is None:
        return None
    try:
        kinds = importlib.import_module("datmo_tools.evaluate.plot_style").KINDS
        draw = getattr(importlib.import_module(f"datmo_tools.evaluate.{module}"), function)
    except ImportError as error:
        raise InputError(f"{error}: expected the package python3-matplotlib") from error
    kind = path.suffix[1:].lower()
    if kind not in kinds:
        raise InputError(f"--plot {path}: expected a name that ends in .{', .'.join(kinds)}")
    return lambda *drawn: draw(*drawn, kind)
