# SPDX-License-Identifier: BSD-3-Clause
"""Formats the report that check_bag prints."""

from datmo_tools.check_bag.findings import Severity
from datmo_tools.check_bag.yaml_text import mount_text
from datmo_tools.text_table import one_line

TITLES = {Severity.ERROR: "ERROR", Severity.WARNING: "warning", Severity.NOTE: "note"}
ADVICE_INDENT = "         -> "


def topics_text(recording):
    """Returns the table of the topics."""
    rows = [("topic", "type", "messages", "Hz", "frame")]
    for topic in sorted(recording.topics.values(), key=lambda item: item.name):
        period = topic.period()
        rate = f"{1.0 / period:.1f}" if period else ""
        cells = (topic.name, topic.type, str(topic.count), rate, topic.frame())
        rows.append(tuple(map(one_line, cells)))
    widths = [max(map(len, column)) for column in zip(*rows)]
    lines = ("  ".join(f"{cell:<{width}}" for cell, width in zip(row, widths)) for row in rows)
    return "\n".join(line.rstrip() for line in lines)


def findings_text(findings):
    """Returns all findings, the most severe first."""
    lines = []
    for item in findings.sorted():
        where = f"{item.where}: " if item.where else ""
        lines.append(f"{TITLES[item.severity]:8} {one_line(where + item.what)}. [{item.kind}]")
        if item.advice:
            lines.append(ADVICE_INDENT + one_line(item.advice))
    return "\n".join(lines or ["No findings."])


def levels_text(levels):
    """Returns what each level of fusion has."""
    lines = []
    for level in levels:
        lacks = "ready" if not level.missing else "missing: " + one_line("; ".join(level.missing))
        lines.append(f"  {level.name:24} {lacks}")
    return "\n".join(lines)


def measured_text(facts, measured, mount, results):
    """Returns what was measured of scanner and motion."""
    lines = []
    if facts is not None:
        lines.append(
            f"  scanner: {facts.beams} beams over {57.2958 * facts.field:.0f} degrees, range up to "
            f"{measured.reach:.1f} m, median {facts.typical:.1f} m"
        )
        if measured.noise is not None:
            lines.append(f"  range noise {1000 * measured.noise:.0f} mm, while the vehicle stands")
        lines.append(f"  beams return from surfaces up to {measured.free_range:.0f} m")
    if mount is not None:
        lines.append(f"  mounted at {mount_text(mount)}")
    for result in results.values():
        lines.append(f"  {one_line(result.signal.source)}: {_fit_text(result)}")
    return "\n".join(lines or ["  nothing"])


def _fit_text(result):
    parts = []
    for name, fit in (("turns", result.turns), ("distances", result.distances)):
        if fit is not None:
            parts.append(
                f"{name} x {fit.scale:.3f} +- {fit.scale_error:.3f}, {1000 * fit.delay:+.0f} ms"
            )
    if not parts:
        return "too little motion, or scans that do not match, for a comparison"
    return "against the scans " + "; ".join(parts)
