"""The figures of score_run that are shown: their names and units, in sections.

The definitions are score_run's; the papers named here are where they come from.
"""

import math
from typing import NamedTuple

from datmo_tools.evaluation_metrics import Metric, higher, lower, near

DEGREES = math.degrees(1.0)
PERCENT = 100.0


class Section(NamedTuple):
    """Metrics that belong together."""

    title: str
    source: str
    metrics: tuple


SECTIONS = (
    Section(
        "Tracking, CLEAR-MOT",
        "Bernardin and Stiefelhagen 2008",
        (
            Metric("MOTA", "clear_mot.mota", "%", PERCENT, 1, higher),
            Metric("MOTP, distance of matches", "clear_mot.motp_m", "m", 1.0, 2, lower),
            Metric("required", "clear_mot.required", "frames"),
            Metric("misses", "clear_mot.misses", "frames", cost=lower),
            Metric("false positives", "clear_mot.false_positives", "frames", cost=lower),
            Metric("id switches", "clear_mot.id_switches", cost=lower),
            Metric("fragmentations", "clear_mot.fragmentations", cost=lower),
            Metric("mostly tracked objects", "clear_mot.mostly_tracked", "%", PERCENT, 0, higher),
            Metric("mostly lost objects", "clear_mot.mostly_lost", "%", PERCENT, 0, lower),
        ),
    ),
    Section(
        "Identity, IDF1",
        "Ristani et al. 2016",
        (
            Metric("IDF1", "identity.idf1", "%", PERCENT, 1, higher),
            Metric("IDP, precision", "identity.idp", "%", PERCENT, 1, higher),
            Metric("IDR, recall", "identity.idr", "%", PERCENT, 1, higher),
        ),
    ),
    Section(
        "HOTA",
        "Luiten et al. 2021",
        (
            Metric("HOTA", "hota.hota", "%", PERCENT, 1, higher),
            Metric("DetA, detection", "hota.deta", "%", PERCENT, 1, higher),
            Metric("AssA, association", "hota.assa", "%", PERCENT, 1, higher),
            Metric("LocA, localisation", "hota.loca", "%", PERCENT, 1, higher),
        ),
    ),
    Section(
        "GOSPA",
        "Rahmathullah et al. 2017",
        (
            Metric("GOSPA, mean of frames", "gospa.mean_m", "m", 1.0, 2, lower),
            Metric("part of localisation", "gospa.localisation_m", "m", 1.0, 2, lower),
            Metric("part of missed objects", "gospa.missed_m", "m", 1.0, 2, lower),
            Metric("part of false tracks", "gospa.false_m", "m", 1.0, 2, lower),
        ),
    ),
    Section(
        "Errors of matched tracks",
        "root mean square, position of the centres",
        (
            Metric("position", "errors.position_rmse_m", "m", 1.0, 2, lower),
            Metric("velocity", "errors.velocity_rmse_mps", "m/s", 1.0, 2, lower),
            Metric("heading", "errors.heading_rmse_rad", "deg", DEGREES, 1, lower),
            Metric(
                "heading, front or back",
                "errors.heading_modulo_pi_rmse_rad",
                "deg",
                DEGREES,
                1,
                lower,
            ),
        ),
    ),
    Section(
        "Honesty of the covariance",
        "Bar-Shalom et al. 2001",
        (
            Metric(
                "NEES of position, 2 is honest",
                "consistency.position.mean_nees",
                "",
                1.0,
                2,
                near(2.0),
            ),
            Metric(
                "inside the 95 % bound",
                "consistency.position.inside_share",
                "%",
                PERCENT,
                1,
                near(95.0),
            ),
            Metric(
                "NEES of velocity, 2 is honest",
                "consistency.velocity.mean_nees",
                "",
                1.0,
                2,
                near(2.0),
            ),
            Metric(
                "inside the 95 % bound",
                "consistency.velocity.inside_share",
                "%",
                PERCENT,
                1,
                near(95.0),
            ),
        ),
    ),
    Section(
        "Counts of the thesis",
        "Baig 2012, tables 3.2 to 3.5",
        (
            Metric("moving objects", "thesis.moving_objects"),
            Metric("missed (3.2)", "thesis.missed_objects", cost=lower),
            Metric("tracks", "thesis.tracks"),
            Metric("false tracks (3.3)", "thesis.false_tracks", cost=lower),
            Metric("tracks confirmed by two sensors (3.3)", "thesis.confirmed_tracks"),
            Metric("of them true (3.3)", "thesis.confirmed_true_tracks"),
            Metric(
                "false moving objects (3.4)",
                "thesis.false_moving_objects_frames",
                "a frame",
                1.0,
                2,
                lower,
            ),
            Metric(
                "false moving objects (3.4)",
                "thesis.false_moving_objects_episodes",
                "episodes",
                cost=lower,
            ),
            Metric("intersections (3.5)", "thesis.intersections"),
            Metric("found (3.5)", "thesis.intersections_found", cost=higher),
            Metric("false (3.5)", "thesis.intersections_false", cost=lower),
        ),
    ),
    Section(
        "Pose of the vehicle",
        "relative errors: Kuemmerle et al. 2009",
        (
            Metric("way", "pose.way_m", "m", 1.0, 1),
            Metric("end point", "pose.end_error_m", "m", 1.0, 2, lower),
            Metric("end point, of the way", "pose.end_error_share", "%", PERCENT, 2, lower),
            Metric("heading at the end", "pose.end_error_deg", "deg", 1.0, 2, lower),
            Metric("position, root mean square", "pose.position_rmse_m", "m", 1.0, 2, lower),
            Metric("heading, root mean square", "pose.heading_rmse_rad", "deg", DEGREES, 2, lower),
            Metric("largest jump within 1 s", "pose.largest_jump_m", "m", 1.0, 2, lower),
            Metric("NEES, 3 is honest", "pose.mean_nees", "", 1.0, 2, near(3.0)),
        ),
    ),
)

OBJECT_METRICS = (
    Metric("from", "first_s", "s", 1.0, 1),
    Metric("to", "last_s", "s", 1.0, 1),
    Metric("required", "required_frames", "frames"),
    Metric("tracked", "tracked_frames", "frames"),
    Metric("complete", "completeness", "%", PERCENT, 1),
    Metric("delay", "delay_s", "s", 1.0, 2),
    Metric("position", "position_rmse_m", "m", 1.0, 2),
    Metric("velocity", "velocity_rmse_mps", "m/s", 1.0, 2),
    Metric("heading", "heading_rmse_rad", "deg", DEGREES, 1),
)

STANDING_METRICS = (
    Metric("in sight", "frames", "frames"),
    Metric("with a false track on it", "tracked_frames", "frames"),
)


def sections_of(runs):
    """SECTIONS, the pose's relative errors and the times of the stages, as the runs hold them."""
    return [
        section._replace(metrics=section.metrics + _relative_errors(runs))
        if section.title.startswith("Pose")
        else section
        for section in SECTIONS
    ] + _timing(runs)


def _relative_errors(runs):
    """Metrics of the errors over each distance; the runs are scored over the same ones."""
    metrics = []
    for i, item in enumerate((runs[0].get("pose") or {}).get("relative") or []):
        over = f"error over {item['distance_m']:.0f} m"
        path = f"pose.relative.{i}"
        metrics.append(Metric(over, f"{path}.translation_m", "m", 1.0, 3, lower))
        metrics.append(Metric(over, f"{path}.rotation_deg", "deg", 1.0, 3, lower))
    return tuple(metrics)


def _timing(runs):
    """Of each stage how long it took, and since the scan, where that is known."""
    metrics = tuple(
        Metric(f"{stage}{what}, {name}", f"timing.{stage}{path}.{key}", "ms", 1.0, 2, lower)
        for stage in sorted({stage for run in runs for stage in run.get("timing") or {}})
        for what, path in (("", ""), (" since the scan", ".latency"))
        if not path or any(_has_latency(run, stage) for run in runs)
        for name, key in (("median", "median_ms"), ("99 %", "p99_ms"), ("worst", "worst_ms"))
    )
    if not metrics:
        return []
    return [Section("Time of each stage", "messages of type StageTiming", metrics)]


def _has_latency(run, stage):
    return bool(((run.get("timing") or {}).get(stage) or {}).get("latency"))
