# SPDX-License-Identifier: BSD-3-Clause
"""Formats a CovarianceTable as yaml for object_fusion, as JSON, and as text."""

import numpy as np

from datmo_tools.text_table import aligned, one_line, rounded

DEGREES = np.degrees(1.0)

NOTE = """\
Left range (m), right bearing (degrees). Known: standard deviation of the differences by what the
lidar's own and the camera's of the sides that it saw; sd: the camera's own."""


def as_yaml(table, source, runs):
    """Returns the table as the section object_fusion of a sensor set."""
    bearings = _numbers(table.bearing.variance)
    return "\n".join([
        f"# How far objects of {source} are off, measured against the lidar's by",
        f"# evaluate calibrate_object_covariance {one_line(' '.join(map(str, runs)))}",
        f"# Bins of {table.bin_width:g} m from 0 m on: pairs and mean differences",
        *(f"# {line}" for line in _bins(table)),
        "object_fusion:",
        "  sources:",
        f"    {source}:",
        "      covariance:",
        f"        bin_width: {float(table.bin_width)}  # m",
        f"        range_variance: [{_numbers(table.range.variance)}]  # m^2",
        f"        bearing_variance: [{bearings}]  # rad^2",
        "",
    ])  # fmt: skip


def as_dictionary(table, counts):
    """Returns what JSON can hold of the table; counts: of object_pairs."""
    columns = {"range": table.range, "bearing": table.bearing}
    return {
        "bin_width_m": table.bin_width,
        "objects": counts._asdict(),
        **{
            name: {
                **{key: _plain(getattr(column, key)) for key in column._fields if key != "law"},
                "law": column.law._asdict(),
            }
            for name, column in columns.items()
        },
    }


def _plain(values):
    return [None if value != value else value for value in values.tolist()]  # NaN is not itself


def _numbers(values):
    return ", ".join(f"{value:.4e}" for value in values)


def _bins(table):
    """Yields one line for each bin."""
    for i, center in enumerate(table.centers):
        near, far = center - 0.5 * table.bin_width, center + 0.5 * table.bin_width
        texts = []
        for column, scale, unit in ((table.range, 1.0, "m"), (table.bearing, DEGREES, "deg")):
            text = f"{column.count[i]} pairs"
            if column.count[i]:
                text += f", {scale * column.bias[i]:+.2f} {unit}"
            mark = _mark(column, i)
            texts.append(f"{text} ({mark})" if mark else text)
        yield f"{near:g}-{far:g} m: {'; '.join(texts)}"


def _mark(column, i):
    """Returns the mark of a bin that is not measured."""
    if column.measured[i]:
        return ""
    return "hidden by the known: law" if column.enough[i] else "too few: law"


def summary(table, counts):
    """Returns the table as text for the terminal; counts: of object_pairs."""
    headings = ["pairs", "bias", "known", "sd", ""]
    rows = [["range, m", *headings, *headings]]
    for i, center in enumerate(table.centers):
        cells = [f"{center:g}"]
        for column, scale in ((table.range, 1.0), (table.bearing, DEGREES)):
            items = (column.bias[i], np.sqrt(column.known_variance[i]), np.sqrt(column.variance[i]))
            cells.append(str(column.count[i]))
            cells += [rounded(None if np.isnan(item) else scale * item, 3) for item in items]
            cells.append(_mark(column, i))
        rows.append(cells)
    distance, bearing = table.range.law, table.bearing.law
    laws = (
        f"range: sqrt({distance.constant:.3g} + {distance.factor:.3g} r^4) m; "
        f"bearing: sqrt({bearing.constant:.3g} + {bearing.factor:.3g} / r^2) rad"
    )
    fates = (
        f"{counts.objects} times that the lidar saw a moving object: {counts.paired} paired; left "
        f"out: {counts.alone} that the camera did not see, {counts.unlike} unlike, {counts.hidden} "
        "with nothing that both saw"
    )
    return "\n".join([NOTE, aligned(rows), laws, fates])
