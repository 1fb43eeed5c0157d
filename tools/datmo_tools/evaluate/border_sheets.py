# SPDX-License-Identifier: BSD-3-Clause
"""Draws sheets of pictures of a run's borders."""

from datmo_tools.evaluate.border_images import draw_image
from datmo_tools.evaluate.border_views import (
    AHEAD_NAME,
    LEFT_NAME,
    SHAPE,
    draw_view,
    legend_handles,
    title,
)
from datmo_tools.evaluate.plot_style import BOTTOM, RIGHT, WIDTH, picture

COLUMNS = 2  # of views from above, without images
IMAGE_SHARE = 2.1  # width of an image relative to that of its view from above
LEFT, GAP = 0.65, 0.65  # inch: margin of the sheet, between two pictures for the axis's name
BETWEEN_ROWS = 0.28  # of a picture's height, for the axis's numbers and the title
LEGEND = 0.8  # inch, the upper margin


def sheets(moments, images, poses, kind, rows):
    """Returns the sheets as a list of bytes.

    moments: of border_recordings; images: dictionary stamp -> CameraImage, None: only views from
    above; poses: PosePath of base_link in the map; kind: of plot_style.KINDS; rows: per sheet.
    """
    each = rows if images is not None else rows * COLUMNS
    parts = [moments[begin : begin + each] for begin in range(0, len(moments), each)]
    if images is None:
        return [_views(part, kind) for part in parts]
    return [_images_and_views(part, images, poses, kind) for part in parts]


def _views(moments, kind):
    rows = -(-len(moments) // COLUMNS)

    def draw(axes):
        for ax, moment in zip(axes.flat, moments):
            draw_view(ax, moment)
            ax.set_title(title(moment), loc="left")
        for ax in axes.flat[len(moments) :]:
            ax.axis("off")
        _finish(axes, moments, 0)

    return _sheet(kind, rows, draw, (1.0,) * COLUMNS)


def _images_and_views(moments, images, poses, kind):
    def draw(axes):
        for (beside, above), moment in zip(axes, moments):
            draw_view(above, moment)
            beside.set_title(title(moment), loc="left")
            image = images.get(moment.stamp)
            if image is None:
                beside.axis("off")
            else:
                draw_image(beside, image, moment, poses.at(image.stamp))
        _finish(axes, moments, -1)

    return _sheet(kind, len(moments), draw, (IMAGE_SHARE, 1.0))


def _finish(axes, moments, column):
    """Labels the lowest axes and those of the column (index), and draws the legend above all."""
    for ax in axes[-1]:
        ax.set_xlabel(AHEAD_NAME)
    for ax in axes[:, column]:
        ax.set_ylabel(LEFT_NAME)
    handles = legend_handles(any(moment.truth is not None for moment in moments))
    figure = axes.flat[0].figure
    figure.legend(handles=handles, loc="upper left", ncol=(len(handles) + 1) // 2, fontsize=8.0,
                  bbox_to_anchor=(0.0, 1.0))  # fmt: skip


def _sheet(kind, rows, draw, widths):
    """widths: of the columns, in any unit; the last one is for views from above."""
    room = WIDTH - LEFT - RIGHT - GAP * (len(widths) - 1)
    view = SHAPE * room * widths[-1] / sum(widths)
    height = view * (rows + BETWEEN_ROWS * (rows - 1)) + LEGEND + BOTTOM
    spacing = {"width_ratios": widths, "wspace": GAP * len(widths) / room}
    return picture(kind, height, draw, left=LEFT, top=LEGEND, between=BETWEEN_ROWS, nrows=rows,
                   ncols=len(widths), squeeze=False, gridspec_kw=spacing)  # fmt: skip
