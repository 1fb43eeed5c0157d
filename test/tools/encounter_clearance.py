# SPDX-License-Identifier: BSD-3-Clause
"""The true clearances of an encounter's host and road user, by the simulator's ground truth."""

import math

import numpy as np
import rosbag

EPOCH = 1000.0  # s, ROS time at which a drive starts
TO_MIDDLE = 1.35  # m, from the rear axle, which follows the path, to the middle of the host
HALF = 2.2, 0.9  # m, half length and width of the host
STEP = 0.02  # s
ON_PATH = 0.05  # m, from its path, of the road user's middle


class Boxes:
    """Boxes of a moving body: middle and heading at each time, all arrays."""

    def __init__(self, middles, headings, half):
        self.middles, self.headings, self.half = middles, headings, half

    def outlines(self, count=9):
        """Returns points on the outlines: an array of times x points x 2."""
        sides = np.linspace(-1.0, 1.0, count)
        one = np.ones(count)
        local = np.concatenate([np.stack(pair, axis=1) for pair in (
            (sides, one), (sides, -one), (one, sides), (-one, sides))]) * self.half  # fmt: skip
        cos, sin = np.cos(self.headings), np.sin(self.headings)
        turn = np.stack([np.stack([cos, -sin], axis=1), np.stack([sin, cos], axis=1)], axis=1)
        return self.middles[:, None, :] + np.einsum("tij,pj->tpi", turn, local)

    def distances(self, points):
        """Returns the distances of points (times x points x 2) from the box of their time; 0: inside."""
        away = points - self.middles[:, None, :]
        cos, sin = np.cos(self.headings)[:, None], np.sin(self.headings)[:, None]
        along = np.abs(cos * away[..., 0] + sin * away[..., 1]) - self.half[0]
        aside = np.abs(cos * away[..., 1] - sin * away[..., 0]) - self.half[1]
        return np.hypot(np.maximum(along, 0.0), np.maximum(aside, 0.0))


def smallest_distance(one, other):
    """Returns the smallest distance (m) of two bodies at the same time."""
    return min(one.distances(other.outlines()).min(), other.distances(one.outlines()).min())


def encroachment_time(host, other):
    """Returns the smallest time (s) between one body and the other in the same place, in either order."""
    best = math.inf
    points = host.outlines(5), other.outlines(5)
    for shift in range(len(host.middles)):
        time = shift * STEP
        if time >= best:
            break
        end = len(host.middles) - shift
        for body, outline in ((host, points[1]), (other, points[0])):
            early = Boxes(body.middles[:end], body.headings[:end], body.half)
            late = Boxes(body.middles[shift:], body.headings[shift:], body.half)
            if early.distances(outline[shift:]).min() == 0.0 or late.distances(outline[:end]).min() == 0.0:
                best = time
    return best


def bodies(scene, bag):
    """Returns Boxes of the host and of the road user at the same times, every STEP."""
    times, user = _user(scene["actors"][0], bag)
    grid = np.arange(times[0], times[-1], STEP)
    middles = np.stack([np.interp(grid, times, [each[axis] for each in user]) for axis in (0, 1)], axis=1)
    other = Boxes(middles, np.full(len(grid), user[0][2]), np.array(user[0][3:]))
    return _host(scene["ego"], grid), other


def _user(actor, bag):
    """Returns times (s) and (x, y, heading, half length, half width) of the object on the actor's path."""
    (x0, y0), (x1, y1) = actor["path"]
    length = math.hypot(x1 - x0, y1 - y0)
    times, found = [], []
    with rosbag.Bag(str(bag)) as opened:
        for _, message, _ in opened.read_messages(["/ground_truth/objects"]):
            for item in message.objects:
                position, turned = item.pose.position, item.pose.orientation
                off = abs((position.x - x0) * (y1 - y0) - (position.y - y0) * (x1 - x0)) / length
                if item.label.lower() == actor["kind"] and off < ON_PATH:
                    times.append(message.header.stamp.to_sec() - EPOCH)
                    found.append((position.x, position.y, 2.0 * math.atan2(turned.z, turned.w),
                                  0.5 * item.size.x, 0.5 * item.size.y))  # fmt: skip
    return np.array(times), found


def _host(ego, times):
    """Straight, or with one corner to the left."""
    at, speeds = zip(*(ego["speed"] + [[ego["speed"][-1][0] + 100.0, ego["speed"][-1][1]]]))
    fine = np.arange(0.0, times[-1] + STEP, 0.1 * STEP)
    lengths = np.interp(times, fine, np.cumsum(np.interp(fine, at, speeds)) * 0.1 * STEP) + ego.get("start", 0.0)
    (x, y), corner = ego["path"][0], ego["path"][1]
    radius = ego.get("corner_radius", 0.0)
    before = corner[0] - x - radius if len(ego["path"]) > 2 else math.inf
    arc = np.clip(lengths - before, 0.0, 0.5 * math.pi * radius)
    angles = arc / radius if radius else np.zeros(len(times))
    after = np.maximum(lengths - before - 0.5 * math.pi * radius, 0.0)
    axles = np.stack([x + np.minimum(lengths, before) + radius * np.sin(angles),
                      y + radius * (1.0 - np.cos(angles)) + after], axis=1)  # fmt: skip
    ahead = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return Boxes(axles + TO_MIDDLE * ahead, angles, np.array(HALF))
