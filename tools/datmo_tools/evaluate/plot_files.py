# SPDX-License-Identifier: BSD-3-Clause
"""Loads matplotlib only where a picture is drawn."""

import importlib

from datmo_tools.errors import InputError


def drawing_module(name):
    """Returns a module of datmo_tools.evaluate that draws. Raises InputError without matplotlib."""
    try:
        return importlib.import_module(f"datmo_tools.evaluate.{name}")
    except ImportError as error:
        raise InputError(f"{error}: expected the package python3-matplotlib") from error


def picture_kind(path, option):
    """Returns the one of plot_style.KINDS that the Path of an option (--NAME) ends in.

    Raises InputError for another ending, and without matplotlib.
    """
    kinds = drawing_module("plot_style").KINDS
    kind = path.suffix[1:].lower()
    if kind not in kinds:
        raise InputError(f"{option} {path}: expected a name that ends in .{', .'.join(kinds)}")
    return kind


def plotter(path, name):
    """Returns a function (data) -> bytes of a picture for the path of --plot; None for no path.

    name: of a module and of its function that draws, with the data and one of plot_style.KINDS.
    Raises InputError as picture_kind() does.
    """
    if path is None:
        return None
    kind = picture_kind(path, "--plot")
    draw = getattr(drawing_module(name), name)
    return lambda *drawn: draw(*drawn, kind)
