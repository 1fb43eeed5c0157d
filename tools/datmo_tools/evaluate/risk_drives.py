# SPDX-License-Identifier: BSD-3-Clause
"""Reads drives with risks as written by run_bag --risk --with-truth."""

import numpy as np

from datmo_fusion.msg import RiskArray, TrueContact
from datmo_tools.bag_input import check_type, opened
from datmo_tools.errors import InputError
from datmo_tools.evaluate.risk_scores import HORIZONS, LIKELY, RiskDrive, RiskFrame, any_contact
from datmo_tools.evaluate.truth import TRUE_OBJECTS, read_true_objects
from datmo_tools.stamps import to_ros_time

RISKS = "/risks"
CONTACT = "/ground_truth/contact"

GAP = 0.5  # s; hidden for longer, the struck object was not in view


def read_drive(path):
    """Returns the RiskDrive of a bag (Path). Raises InputError if there are no risks in it."""
    frames, contact = [], None
    with opened(path) as bag:
        for topic, message, _ in bag.read_messages([RISKS, CONTACT]):
            check_type(path, topic, message, RiskArray if topic == RISKS else TrueContact)
            if topic == RISKS:
                frames.append(_frame(message.header.stamp.to_sec(), message))
            else:
                contact = message
    if not frames:
        raise InputError(f"{path}: nothing on {RISKS}, expected a bag of run_bag --risk --with-truth")
    objects = {to_ros_time(stamp).to_sec(): items
               for stamp, items in sorted(read_true_objects(path).items())}  # fmt: skip
    if not objects:
        raise InputError(f"{path}: nothing on {TRUE_OBJECTS}, expected a bag of run_bag --with-truth")
    frames.sort(key=lambda frame: frame.time)
    if contact is None:
        return RiskDrive(path.stem, frames, max(frames[-1].time, *objects), None, None)
    time = contact.header.stamp.to_sec()
    before = [frame for frame in frames if frame.time < time]
    seen = [when for when, items in objects.items()
            if any(item.id == contact.id and item.lidar_beams > 0 for item in items)]  # fmt: skip
    return RiskDrive(path.stem, before, time, time, _in_view_since(seen, time))


def _in_view_since(times, end):
    """Returns the start of the last part of `times` (s, rising) without a gap; None if empty."""
    since = None
    for later, earlier in zip([end, *times[::-1]], times[::-1]):
        if later - earlier > GAP:
            break
        since = earlier
    return since


def _frame(time, message):
    probability = tuple(
        any_contact([risk.contact_probability[index] for risk in message.risks])
        for index in range(len(HORIZONS))
    )
    likeliest = max(message.risks, key=lambda risk: risk.contact_probability[-1], default=None)
    ttc = None
    if likeliest is not None and likeliest.contact_probability[-1] >= LIKELY:
        ttc = likeliest.median_ttc if np.isfinite(likeliest.median_ttc) else None
    return RiskFrame(time, message.level, probability, ttc)
