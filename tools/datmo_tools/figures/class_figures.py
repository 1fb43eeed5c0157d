# SPDX-License-Identifier: BSD-3-Clause
"""Figures of classes, of all steps that measure a camera's classes."""

from datmo_tools.evaluate.class_tally import NOTHING

CLASSES = ("vehicle", "cyclist", "pedestrian")


def class_figures(scored):
    """Returns by true class and range how many of the reported classes are right, how often classes
    are right at which probability, and how many are reported where the truth has nothing.

    scored: with bands_m, confusion and calibration, of evaluate.
    """
    reported = [sum(said.values()) for table in scored["confusion"] for said in table.values()]
    nothing = sum(sum(table[NOTHING].values()) for table in scored["confusion"])
    return {
        "right": {kind: {band_name(*band): [table[kind][kind], sum(table[kind].values())]
                         for band, table in zip(scored["bands_m"], scored["confusion"])}
                  for kind in CLASSES},
        "reported": sum(reported),
        "on_nothing": nothing,
        "calibration": [[item["said"], item["right"], item["count"]] for item in scored["calibration"]],
    }  # fmt: skip


def band_name(near, far):
    """Returns the name of a range between two bounds, m."""
    return f"{near:g} to {far:g} m"
