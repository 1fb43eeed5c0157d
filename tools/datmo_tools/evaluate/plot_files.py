# SPDX-License-Identifier: BSD-3-Clause
"""Pictures that a command line may ask for: matplotlib is loaded for them alone."""

import importlib

from datmo_tools.errors import InputError


def plotter(path, module, function):
    """Function (what is drawn) -> bytes of a picture for the path; None where the path is.

    module, function: of datmo_tools.evaluate, what draws: it is given what is drawn and one of
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
