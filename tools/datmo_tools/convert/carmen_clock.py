# SPDX-License-Identifier: BSD-3-Clause
"""Puts the records of a CARMEN log into an order with increasing stamps, which a bag needs.

Old logs have the time at which a message reached the logger, not the time of the measurement: on
a busy computer the stamps of the lines come in bursts, and out of order. There are two methods to
make them increase, and neither gives the true stamps:

log:   every record keeps its stamp, and the records are sorted by it. Scans may change their order.
order: the records keep the order of the file, in which they were measured; the scans' stamps are
       moved, all together by as little as possible, until they increase nearly as evenly as the
       scanner turns. Stamps that already do are not changed.
"""

from typing import NamedTuple

import numpy as np

from datmo_tools.convert.carmen_lines import OdometryLine
from datmo_tools.convert.carmen_log import Record

CLOCKS = ("log", "order")

# The typical time between two scans is the median, over a neighborhood of scans on both sides, of
# spans of this many scans: bursts average out, pauses do not count, and the rate may change.
TYPICAL_OVER = 10
NEIGHBORHOOD = 100
# A scanner turns evenly: a scan follows the previous one after this share of the typical time or
# later.
MIN_SHARE = 0.9

# Odometry this close to a scan or to earlier odometry gives no speed, as its stamps and digits are
# too coarse, and no new information.
MIN_STEP = 20_000_000  # ns


class TimedRecord(NamedTuple):
    """A record and its time."""

    stamp: int  # ns
    record: Record

    @property
    def is_scan(self):
        """Whether it is a scan, else it is odometry."""
        return not isinstance(self.record.line, OdometryLine)


def timeline(records, clock):
    """Returns TimedRecords with increasing stamps; `clock`: one of CLOCKS.

    records: in the order of the file. All scans are kept, except with the clock `log` those with a
    repeated stamp. Odometry lines are kept if they are at least MIN_STEP from their neighbors.
    """
    timed = _by_stamp(records) if clock == "log" else _by_order(records)
    return _thinned(timed)


def rising(stamps, min_steps):
    """Returns the stamps (ns) closest to `stamps` in least squares in which each one follows the
    previous one by at least `min_steps` (ns, one for each pair of neighbors).

    Isotonic regression by pooling adjacent violators (Barlow et al., "Statistical inference under
    order restrictions", 1972), of the stamps minus the cumulative minimum steps.
    """
    minimum = np.concatenate([[0], np.cumsum(min_steps, dtype=np.int64)])
    pools = []  # mean and number of stamps that are moved onto one line
    for stamp, offset in zip(stamps, minimum):
        mean, count = float(stamp - stamps[0] - offset), 1
        while pools and pools[-1][0] > mean:
            before, more = pools.pop()
            mean = (before * more + mean * count) / (more + count)
            count += more
        pools.append((mean, count))
    slack = np.repeat([mean for mean, _ in pools], [count for _, count in pools])
    return [stamps[0] + round(extra) + int(offset) for extra, offset in zip(slack, minimum)]


def typical_steps(stamps):
    """Returns the typical time (ns) to the next one for each of `stamps` (ns) but the last."""
    over = min(TYPICAL_OVER, len(stamps) - 1)
    spans = np.asarray(stamps[over:]) - np.asarray(stamps[:-over])
    steps = []
    for i in range(len(stamps) - 1):
        center = min(max(i - over // 2, 0), len(spans) - 1)
        near = spans[max(center - NEIGHBORHOOD, 0) : center + NEIGHBORHOOD + 1]
        steps.append(max(int(np.median(near)) // over, 2))
    return steps


def _by_stamp(records):
    timed = sorted(
        (TimedRecord(record.line.stamp, record) for record in records),
        key=lambda item: (item.stamp, not item.is_scan),
    )
    return [timed[0]] + [b for a, b in zip(timed, timed[1:]) if b.stamp > a.stamp]


def _by_order(records):
    timed = [TimedRecord(record.line.stamp, record) for record in records]
    positions = [i for i, item in enumerate(timed) if item.is_scan]
    stamps = [timed[i].stamp for i in positions]
    if len(stamps) > 1:
        stamps = rising(stamps, [int(MIN_SHARE * step) for step in typical_steps(stamps)])
    for i, stamp in zip(positions, stamps):
        timed[i] = timed[i]._replace(stamp=stamp)
    return timed


def _thinned(timed):
    """Drops odometry that does not fit between its neighbors."""
    kept = []
    next_scan = _next_scans(timed)
    for item, scan in zip(timed, next_scan):
        after = not kept or item.stamp >= kept[-1].stamp + MIN_STEP
        before = scan is None or item.stamp <= scan - MIN_STEP
        if item.is_scan or (after and before):
            kept.append(item)
    return kept


def _next_scans(timed):
    """Returns for each record the stamp of the next scan, or of its own; None after the last."""
    upcoming, found = None, []
    for item in reversed(timed):
        upcoming = item.stamp if item.is_scan else upcoming
        found.append(upcoming)
    return found[::-1]
