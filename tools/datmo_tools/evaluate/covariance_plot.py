# SPDX-License-Identifier: BSD-3-Clause
"""Plots a CovarianceTable: standard deviations over range."""

import numpy as np

from datmo_tools.evaluate.plot_style import FALSE, INK, TRUTH, series_color, picture

NEAR_BINS = 2
HEADROOM = 1.3  # above the highest point, for the legend


def covariance_plot(table, depth_sigma, kind):
    """Returns the bytes of the picture.

    depth_sigma: function of depth (m) -> standard deviation (m) expected by theory straight ahead,
    or None; kind: of plot_style.KINDS.
    """

    def draw(axes):
        _draw(axes[0], table, table.range, 1.0)
        if depth_sigma is not None:
            ranges = _ranges(table)
            label = "theory: disparities of constant noise"
            axes[0].plot(ranges, depth_sigma(ranges), color=FALSE, linestyle="--", label=label)
        axes[0].set_title("Range, standard deviation (m)", loc="left")
        _draw(axes[1], table, table.bearing, np.degrees(1.0))
        axes[1].set_title("Bearing, standard deviation (degrees)", loc="left")
        axes[1].set_xlabel("range (m)")
        for ax in axes:
            ax.legend(loc="upper left", ncol=2)

    return picture(kind, 6.0, draw, nrows=2, sharex=True)


def _ranges(table):
    return np.linspace(0.5 * table.bin_width, table.bin_width * len(table.centers), 200)


def _draw(ax, table, column, scale):
    """scale: of the unit in the plot."""
    sigmas, centers, measured = scale * np.sqrt(column.variance), table.centers, column.measured
    ranges = _ranges(table)
    # The relative error of a standard deviation of n samples is 1 / sqrt(2 n).
    spread = sigmas[measured] / np.sqrt(2.0 * column.count[measured])
    ax.plot(ranges, scale * np.sqrt(column.law.at(ranges)), color=series_color(0), label="fitted law")
    ax.errorbar(centers[measured], sigmas[measured], spread, fmt="o", color=INK, markersize=4,
                label="measured")  # fmt: skip
    ax.plot(centers[~measured], sigmas[~measured], "o", color=INK, markersize=4,
            markerfacecolor="none", label="not measured: of the law")  # fmt: skip
    ax.plot(centers, scale * np.sqrt(column.known_variance), color=TRUTH, label="known, taken out")
    ax.plot(centers, scale * np.abs(column.bias), ".", color=series_color(1), label="bias, absolute")
    # A bearing's deviation is unbounded near the sensor: the first bins do not set the scale.
    scaling = sigmas[NEAR_BINS:] if len(sigmas) > NEAR_BINS else sigmas
    ax.set_ylim(0.0, HEADROOM * float(np.max(scaling)))
