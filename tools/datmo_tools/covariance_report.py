"""A CovarianceTable as yaml for object_fusion, as JSON, and as text."""

import numpy as np

from datmo_tools.text_table import aligned, rounded


def as_yaml(table, source, runs):
    """Text of the table as the section object_fusion of a sensor set."""
    bearings = _numbers(table.bearing.variance)
    return "\n".join([
        f"# How far objects of {source} are off, measured against the lidar's by",
        f"# calibrate_object_covariance {' '.join(map(str, runs))}",
        f"# Bins of {table.bin_width:g} m from 0 m on; pairs, bias of range and bearing:",
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
    """What JSON can hold of the table; counts: of object_pairs."""
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
    """One line for each bin."""
    for i, centre in enumerate(table.centres):
        near, far = centre - 0.5 * table.bin_width, centre + 0.5 * table.bin_width
        text = f"{near:g}-{far:g} m: {table.range.count[i]}"
        if table.range.count[i]:
            text += f", {table.range.bias[i]:+.2f} m, {np.degrees(table.bearing.bias[i]):+.2f} deg"
        yield text if table.range.measured[i] else f"{text}; too few, so of the law"


def summary(table, counts):
    """The table as text for the terminal; counts: of object_pairs."""
    rows = [["range, m", "pairs", "bias, m", "sd, m", "lidar, m", "bias, deg", "sd, deg",
             "lidar, deg", ""]]  # fmt: skip
    for i, centre in enumerate(table.centres):
        cells = [f"{centre:g}", str(table.range.count[i])]
        for column, scale in ((table.range, 1.0), (table.bearing, np.degrees(1.0))):
            known = (column.bias[i], np.sqrt(column.variance[i]), np.sqrt(column.lidar_variance[i]))
            cells += [rounded(None if np.isnan(item) else scale * item, 3) for item in known]
        rows.append([*cells, "" if table.range.measured[i] else "of the law"])
    distance, bearing = table.range.law, table.bearing.law
    laws = (
        f"range: sqrt({distance.constant:.3g} + {distance.factor:.3g} r^4) m; "
        f"bearing: sqrt({bearing.constant:.3g} + {bearing.factor:.3g} / r^2) rad"
    )
    fates = (
        f"{counts.objects} objects of the camera: {counts.paired} paired; left out: {counts.alone} "
        f"alone, {counts.unlike} unlike the lidar's, {counts.hidden} with hidden ends"
    )
    return "\n".join([aligned(rows), laws, fates])
