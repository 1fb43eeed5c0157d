# SPDX-License-Identifier: BSD-3-Clause
"""Reads drives with risks as written by run_bag --risk --with-truth."""

import numpy as np

from datmo_fusion.msg import RiskArray
from datmo_tools.bag_input import check_type, opened
from datmo_tools.errors import InputError
from datmo_tools.evaluate.risk_scores import HORIZONS, LIKELY, RiskDrive, RiskFrame, any_contact

RISKS = "/risks"
CONTACT = "/ground_truth/contact"
OBJECTS = "/ground_truth/objects"

GAP = 0.5  # s; hidden for longer, the struck object was not in view


def read_drive(path):
    """Returns the RiskDrive of a bag (Path). Raises InputError if there are no risks in it."""
    frames, contact, stamps, seen = [], None, [], {}
    with opened(path) as bag:
        for topic, message, _ in bag.read_messages([RISKS, CONTACT, OBJECTS]):
            time = message.header.stamp.to_sec()
            if topic == RISKS:
                check_type(path, topic, message, RiskArray)
                frames.append(_frame(time, message))
            elif topic == CONTACT:
                contact = message
            else:
                stamps.append(time)
                for item in message.objects:
                    if item.lidar_beams > 0:
                        seen.setdefault(item.id, []).append(time)
    if not frames:
        raise InputError(f"{path}: nothing on {RISKS}, expected a bag of run_bag --risk --with-truth")
    if not stamps:
        raise InputError(f"{path}: nothing on {OBJECTS}, expected a bag of run_bag --with-truth")
    frames.sort()
    if contact is None:
        return RiskDrive(path.stem, frames, max(frames[-1].time, stamps[-1]), None, None)
    time = contact.header.stamp.to_sec()
    before = [frame for frame in frames if frame.time < time]
    return RiskDrive(path.stem, before, time, time, _in_view_since(seen.get(contact.id, []), time))


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
