# SPDX-License-Identifier: BSD-3-Clause
"""Checks the stamps of every topic: rate, gaps, jumps, order, and against the record time."""

import numpy as np

from datmo_tools.check_bag import recording as kinds

# A gap is this many periods, and at least this many seconds.
GAP_PERIODS = 3.5
MIN_GAP = 0.25
LOST_PERIODS = 1.6  # a step of this many periods lost a message
LOST_SHARE = 0.05  # of the messages, above which it is reported
JUMP_BACK = 1.0  # s: from here on the stack treats it as a restart
MIN_SCAN_RATE = 5.0  # Hz, below which people and cars move too far between two scans
MAX_LATENCY = 0.5  # s, from a header's stamp to its record time
MAX_LEAD = 0.02  # s, by which a stamp may be ahead of its record time
MAX_SPREAD = 0.3  # s, between the latencies of two sensors, and of one (5 to 95 %)
RATE_TOLERANCE = 1.5  # times the period that the scan itself states
MIN_MESSAGES = 5
MIN_SCAN_TIME = 0.01  # s: a smaller value was not set
SENSORS = (*kinds.SCANS, kinds.ODOMETRY, kinds.IMU, kinds.CLOUD, kinds.IMAGE, *kinds.TWISTS)


def check_timing(recording, roles, findings):
    """Adds findings on the stamps of the sensors' topics."""
    latencies = {}
    for topic in recording.of_type(*SENSORS):
        if topic.name.startswith("/ground_truth"):
            continue
        _check_present(topic, findings)
        if len(topic.stamps) < MIN_MESSAGES:
            continue
        stamps, recorded = np.array(topic.stamps), np.array(topic.recorded)
        _check_order(topic, stamps, findings)
        _check_gaps(topic, stamps, findings)
        if len(stamps) == len(recorded):
            latencies[topic.name] = recorded - stamps
    _check_latencies(latencies, findings)
    if roles.scan:
        _check_scan_rate(recording, roles.scan, findings)


def _check_present(topic, findings):
    if topic.unstamped:
        findings.error(
            "no_stamp", topic.name,
            f"{topic.unstamped} of {topic.count} messages have stamp 0",
            "Set header.stamp in the driver; the stack orders everything by it.",
        )  # fmt: skip


def _check_order(topic, stamps, findings):
    steps = np.diff(stamps)
    jumps = np.flatnonzero(steps < -JUMP_BACK)
    swaps = np.flatnonzero((steps < 0.0) & (steps >= -JUMP_BACK))
    repeats = np.count_nonzero(steps == 0.0)
    if len(jumps):
        findings.error(
            "stamp_jump_back", topic.name,
            f"the stamps jump back {len(jumps)} times, first by {-steps[jumps[0]]:.2f} s after "
            f"{stamps[jumps[0]]:.2f} s",
            "Each jump restarts the stack. Split the recording there (rosbag filter), or find what "
            "set the clock of that machine while it recorded.",
        )  # fmt: skip
    if len(swaps):
        findings.warn(
            "stamp_order", topic.name,
            f"{len(swaps)} messages are older than the one before them, first at "
            f"{stamps[swaps[0] + 1]:.2f} s by {-steps[swaps[0]]:.3f} s",
            "Such messages are dropped. Use one publisher per topic, and no retransmission.",
        )  # fmt: skip
    if repeats:
        findings.warn(
            "stamp_repeated", topic.name,
            f"{repeats} messages have the same stamp as the one before them",
            "The second one is dropped. Look for two publishers, or a driver with coarse stamps.",
        )  # fmt: skip


def _check_gaps(topic, stamps, findings):
    steps = np.diff(np.sort(stamps))
    steps = steps[steps > 0.0]
    if not len(steps):
        return
    period = float(np.median(steps))
    limit = max(GAP_PERIODS * period, MIN_GAP)
    gaps = steps[steps > limit]
    if len(gaps):
        at = np.sort(stamps)[:-1][np.diff(np.sort(stamps)) > limit]
        findings.warn(
            "stamp_gap", topic.name,
            f"{len(gaps)} gaps, the longest {gaps.max():.2f} s (period {period:.3f} s), the first "
            f"at {at[0]:.2f} s",
            "Moving objects are lost meanwhile. Check the load of the recorder and the bus.",
        )  # fmt: skip
    lost = np.count_nonzero((steps > LOST_PERIODS * period) & (steps <= limit))
    if lost > LOST_SHARE * len(steps):
        findings.warn(
            "messages_lost", topic.name,
            f"{lost} of {len(steps)} steps are longer than {LOST_PERIODS} periods of "
            f"{period:.3f} s: messages were lost",
            "Record on the sensor's machine, or with a larger buffer (rosbag record -b).",
        )  # fmt: skip


def _check_latencies(latencies, findings):
    medians = {}
    for name, latency in latencies.items():
        low, middle, high = np.percentile(latency, [5, 50, 95])
        medians[name] = middle
        if middle > MAX_LATENCY or middle < -MAX_LEAD:
            findings.warn(
                "record_time", name,
                f"recorded {middle:+.3f} s after the header's stamp (median), expected 0 to "
                f"{MAX_LATENCY} s",
                "The sensor's clock differs from the recorder's: synchronize them (chrony, PTP). "
                "run_bag takes the order from the record time and the time from the header.",
            )  # fmt: skip
        elif high - low > MAX_SPREAD:
            findings.warn(
                "latency_varies", name,
                f"latency from stamp to record time is {low:.3f} to {high:.3f} s (5 to 95 %)",
                "A busy machine or network, or a drifting clock: others' messages come first.",
            )  # fmt: skip
    _check_clocks(medians, findings)


def _check_clocks(medians, findings):
    if len(medians) < 2:
        return
    slowest, fastest = max(medians, key=medians.get), min(medians, key=medians.get)
    if medians[slowest] - medians[fastest] > MAX_SPREAD:
        findings.warn(
            "clocks_differ", slowest,
            f"is recorded {medians[slowest]:.3f} s after its stamp, {fastest} "
            f"{medians[fastest]:+.3f} s: their clocks differ, or one of them is slow",
            "Synchronize the clocks of both machines before the next recording.",
        )  # fmt: skip


def _check_scan_rate(recording, name, findings):
    topic = recording.topics[name]
    period = topic.period()
    if period is None:
        return
    if 1.0 / period < MIN_SCAN_RATE - 0.1:
        findings.warn(
            "low_rate", name,
            f"{1.0 / period:.1f} scans per second, expected {MIN_SCAN_RATE:.0f} or more",
            "Moving objects are hard to track from scan to scan: raise the rate, or drive slowly.",
        )  # fmt: skip
    claimed = np.median([scan.scan_time for scan in recording.scans.get(name, [])] or [0.0])
    if claimed > MIN_SCAN_TIME and period > RATE_TOLERANCE * claimed:
        findings.warn(
            "rate_below_scan_time", name,
            f"a scan arrives every {period:.3f} s, but scan_time is {claimed:.3f} s",
            "Every other scan is lost, or the driver's scan_time is wrong.",
        )  # fmt: skip
