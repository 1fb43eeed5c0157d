# SPDX-License-Identifier: BSD-3-Clause
"""The figures of score_run that are shown: their names and units, in groups.

The definitions are score_run's; the papers named here are their sources.
"""

import math
from typing import NamedTuple

from datmo_tools.evaluate.metrics import Metric, higher, lower, near

DEGREES = math.degrees(1.0)
PERCENT = 100.0


class MetricGroup(NamedTuple):
    """Metrics that belong together."""

    title: str
    source: str
    metrics: tuple


def _percent(name, path, cost=higher, digits=1):
    return Metric(name, path, "%", PERCENT, digits, cost)


def _meters(name, path):
    return Metric(name, path, "m", 1.0, 2, lower)


def _degrees(name, path, digits=1):
    return Metric(name, path, "deg", DEGREES, digits, lower)


def _consistency(quantity, path, degrees_of_freedom):
    """Returns the NEES metrics of a quantity, and the number of states without one."""
    name = f"NEES of {quantity}, {degrees_of_freedom} is consistent"
    return (
        Metric(name, f"{path}.mean_nees", "", 1.0, 2, near(float(degrees_of_freedom))),
        Metric("not positive definite", f"{path}.unusable", "matrices", cost=lower),
    )


def _attainable(name, path):
    """Returns the delay metrics of the objects of a class, or of all."""
    return (
        Metric(f"{name}: attainable, median", f"{path}.attainable_s.median", "s", 1.0, 2),
        Metric(f"{name}: excess, median", f"{path}.excess_s.median", "s", 1.0, 2, lower),
        Metric(f"{name}: excess, 90 %", f"{path}.excess_s.p90", "s", 1.0, 2, lower),
        Metric(f"{name}: ratio, median", f"{path}.ratio.median", "1", 1.0, 1, lower),
        Metric(f"{name}: ratio, 90 %", f"{path}.ratio.p90", "1", 1.0, 1, lower),
    )


METRIC_GROUPS = (
    MetricGroup(
        "Tracking, CLEAR-MOT",
        "Bernardin and Stiefelhagen 2008",
        (
            _percent("MOTA", "clear_mot.mota"),
            _meters("MOTP, distance of matches", "clear_mot.motp_m"),
            Metric("required", "clear_mot.required", "frames"),
            Metric("misses", "clear_mot.misses", "frames", cost=lower),
            Metric("false positives", "clear_mot.false_positives", "frames", cost=lower),
            Metric("false moving tracks", "false_movers_per_frame", "a frame", 1.0, 2, lower),
            Metric("id switches", "clear_mot.id_switches", cost=lower),
            Metric("fragmentations", "clear_mot.fragmentations", cost=lower),
            _percent("mostly tracked objects", "clear_mot.mostly_tracked", digits=0),
            _percent("mostly lost objects", "clear_mot.mostly_lost", lower, digits=0),
        ),
    ),
    MetricGroup(
        "Identity, IDF1",
        "Ristani et al. 2016",
        (
            _percent("IDF1", "identity.idf1"),
            _percent("IDP, precision", "identity.idp"),
            _percent("IDR, recall", "identity.idr"),
        ),
    ),
    MetricGroup(
        "HOTA",
        "Luiten et al. 2021",
        (
            _percent("HOTA", "hota.hota"),
            _percent("DetA, detection", "hota.deta"),
            _percent("AssA, association", "hota.assa"),
            _percent("LocA, localization", "hota.loca"),
        ),
    ),
    MetricGroup(
        "GOSPA",
        "Rahmathullah et al. 2017",
        (
            _meters("GOSPA, mean of frames", "gospa.mean_m"),
            _meters("localization part", "gospa.localization_m"),
            _meters("missed-object part", "gospa.missed_m"),
            _meters("false-track part", "gospa.false_m"),
        ),
    ),
    MetricGroup(
        "Errors of matched tracks",
        "root mean square, position of the centers",
        (
            _meters("position", "errors.position_rmse_m"),
            Metric("velocity", "errors.velocity_rmse_mps", "m/s", 1.0, 2, lower),
            _degrees("heading", "errors.heading_rmse_rad"),
            _degrees("heading, front or back", "errors.heading_modulo_pi_rmse_rad"),
        ),
    ),
    MetricGroup(
        "Errors of matched tracks near the vehicle",
        "within score_run's near_range of it",
        (
            _meters("position", "near_errors.position_rmse_m"),
            Metric("velocity", "near_errors.velocity_rmse_mps", "m/s", 1.0, 2, lower),
        ),
    ),
    MetricGroup(
        "Class of matched tracks",
        "of the frames in which the true class is known",
        (
            _percent("right", "classes.right_share"),
            *(
                _percent(f"right of {name}s", f"classes.by_class.{name}.right_share")
                for name in ("pedestrian", "cyclist", "vehicle")
            ),
            Metric("class unknown", "classes.silent", "frames", cost=lower),
        ),
    ),
    MetricGroup(
        "Delay to the first track of an object",
        "from the first frame in which it has to be found, of those that were found",
        (
            Metric("mean", "delay.mean_s", "s", 1.0, 2, lower),
            Metric("median", "delay.median_s", "s", 1.0, 2, lower),
        ),
    ),
    MetricGroup(
        "Consistency of the covariance",
        "Bar-Shalom et al. 2001",
        (
            *_consistency("position", "consistency.position", 2),
            _percent("inside the 95 % bound", "consistency.position.inside_share", near(95.0)),
            *_consistency("velocity", "consistency.velocity", 2),
            _percent("inside the 95 % bound", "consistency.velocity.inside_share", near(95.0)),
        ),
    ),
    MetricGroup(
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
    MetricGroup(
        "Pose of the vehicle",
        "relative errors: Kuemmerle et al. 2009",
        (
            Metric("distance", "pose.path_length_m", "m", 1.0, 1),
            _meters("end point", "pose.end_error_m"),
            _percent("end point, of the distance", "pose.end_error_share", lower, digits=2),
            Metric("heading at the end", "pose.end_error_deg", "deg", 1.0, 2, lower),
            _meters("position, root mean square", "pose.position_rmse_m"),
            _degrees("heading, root mean square", "pose.heading_rmse_rad", 2),
            _meters("largest jump within 1 s", "pose.largest_jump_m"),
            *_consistency("the pose", "pose", 3),
        ),
    ),
)

ATTAINABLE_GROUP = MetricGroup(
    "Delay compared with the attainable minimum",
    "with --attainable: of an observer who knows which beams end on which object, and its "
    "shape; excess: delay less that; ratio: (delay + scan period) / (attainable + scan period)",
    tuple(
        metric
        for name, path in (
            ("all", "attainable"),
            *((name, f"attainable.by_class.{name}")
              for name in ("pedestrian", "cyclist", "vehicle")),
        )
        for metric in _attainable(name, path)
    ),
)

OBJECT_METRICS = (
    Metric("from", "first_s", "s", 1.0, 1),
    Metric("to", "last_s", "s", 1.0, 1),
    Metric("required", "required_frames", "frames"),
    Metric("tracked", "tracked_frames", "frames"),
    Metric("complete", "completeness", "%", PERCENT, 1),
    Metric("delay", "delay_s", "s", 1.0, 2),
    Metric("attainable", "attainable_delay_s", "s", 1.0, 2),
    Metric("ratio", "delay_ratio", "1", 1.0, 1),
    Metric("position", "position_rmse_m", "m", 1.0, 2),
    Metric("velocity", "velocity_rmse_mps", "m/s", 1.0, 2),
    Metric("heading", "heading_rmse_rad", "deg", DEGREES, 1),
)

STANDING_METRICS = (
    Metric("visible", "frames", "frames"),
    Metric("with a false track on it", "tracked_frames", "frames"),
)


def metric_groups(runs):
    """Returns METRIC_GROUPS, the pose's relative errors, attainable delays, and times."""
    return [
        group._replace(metrics=group.metrics + _relative_errors(runs))
        if group.title.startswith("Pose")
        else group
        for group in METRIC_GROUPS
    ] + _attainable_delays(runs) + _timing(runs)


def _attainable_delays(runs):
    """Returns the delays, if score_run was given the scans."""
    return [ATTAINABLE_GROUP] if any(run.get("attainable") for run in runs) else []


def _relative_errors(runs):
    """Returns metrics of the errors over each distance, which is the same for all runs."""
    metrics = []
    for i, item in enumerate((runs[0].get("pose") or {}).get("relative") or []):
        over = f"error over {item['distance_m']:.0f} m"
        path = f"pose.relative.{i}"
        metrics.append(Metric(over, f"{path}.translation_m", "m", 1.0, 3, lower))
        metrics.append(Metric(over, f"{path}.rotation_deg", "deg", 1.0, 3, lower))
    return tuple(metrics)


def _timing(runs):
    """Returns how long each stage took, and since the scan if that is known."""
    metrics = tuple(
        Metric(f"{stage}{what}, {name}", f"timing.{stage}{path}.{key}", "ms", 1.0, 2, lower)
        for stage in sorted({stage for run in runs for stage in run.get("timing") or {}})
        for what, path in (("", ""), (" since the scan", ".latency"))
        if not path or any(_has_latency(run, stage) for run in runs)
        for name, key in (("median", "median_ms"), ("99 %", "p99_ms"), ("worst", "worst_ms"))
    )
    if not metrics:
        return []
    return [MetricGroup("Time of each stage", "messages of type StageTiming", metrics)]


def _has_latency(run, stage):
    return bool(((run.get("timing") or {}).get(stage) or {}).get("latency"))
