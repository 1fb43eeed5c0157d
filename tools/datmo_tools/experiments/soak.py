# SPDX-License-Identifier: BSD-3-Clause
"""Measures what hours of driving do to memory and latency: lines fitted to samples."""

import numpy as np

# share of the samples during which windows, histories and caches fill, at most.
SETTLED_SHARE = 0.5
SETTLED_HOURS = 0.5  # until the map is full, at 5 m/s: 2000 tiles


def drift(hours, values):
    """Returns the growth per hour of samples by a straight line, without the initial filling
    (dict): `per_hour`, its standard error, and the samples' median. hours (rising), values: n >=
    5."""
    hours, values = np.asarray(hours, dtype=float), np.asarray(values, dtype=float)
    settled = hours >= hours[0] + min(SETTLED_HOURS, SETTLED_SHARE * (hours[-1] - hours[0]))
    x, y = hours[settled], values[settled]
    (slope, _), covariance = np.polyfit(x, y, 1, cov=True)
    return {"per_hour": float(slope), "error": float(np.sqrt(covariance[0, 0])), "median": float(np.median(y))}


def of_stack(samples):
    """Returns figures (dict) of the minutes that soak_stack wrote (list of dict)."""
    hours = [sample["hours"] for sample in samples]
    return {
        "hours": hours[-1],
        "minutes": len(samples),
        "dropped": samples[-1]["dropped"],
        "tracks_least": min(sample["tracks"] for sample in samples),
        **{key: drift(hours, [sample[key] for sample in samples])
           for key in ("heap_mib", "resident_mib", "median_ms", "percentile_99_ms")},
    }  # fmt: skip


def of_nodelets(samples, seconds):
    """Returns figures (dict) of the load test's output (dict of lists of [s, value]), up to
    `seconds`, before the load began."""
    def until(pairs):
        return np.array([pair for pair in pairs if pair[0] < seconds])

    memory, tracks = until(samples["memory_mib"]), until(samples["tracks"])
    return {
        "hours": seconds / 3600.0,
        "resident_mib": drift(memory[:, 0] / 3600.0, memory[:, 1]),
        "latency_ms": drift(tracks[:, 0] / 3600.0, 1e3 * tracks[:, 1]),
    }
