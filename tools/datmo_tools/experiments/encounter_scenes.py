# SPDX-License-Identifier: BSD-3-Clause
"""Encounters following the public test protocols of emergency brakes and forward collision warnings
(Euro NCAP AEB C2C and VRU 2023), as scenes of the simulator: one description, all speeds, each with
a collision and with near misses."""

import math
from typing import NamedTuple

KMH = 1.0 / 3.6  # m/s

HOST_Y = -2.0  # m, the host's lane; the road's middle is y = 0
FRONT = 1.35 + 2.2  # m, from the rear axle to the bumper of the simulator's car
HALF_WIDTH = 0.9  # m, of the host
MEETING = 7.0  # s, when they meet: the map has been built by then
AFTER = 3.0  # s, how long the drive continues
CLEARANCE = 1.0  # m, of a near miss in space
CLEAR_TIME = 1.5  # s, of a near miss in time
ROAD = (-60.0, 320.0)  # m, from and to
CORNER_LEAD = 3.8  # m, by which the left corner of a turning bumper is in the other lane before its middle
BEYOND = 4.5  # m, beyond the lane's middle, where a crossing road user stands


class Encounter(NamedTuple):
    """One drive: which road user meets the host, the speeds of both, and how it ends."""

    protocol: str  # a key of PROTOCOLS
    host: float  # km/h
    ending: str  # one of ENDINGS, STOPS or AVOIDED

    @property
    def name(self):
        """Returns the name of its files."""
        return f"{self.protocol}_{self.host:.0f}_{self.ending}"


# A crossing road user has passed the host's side by CLEARANCE when the bumper arrives ("space"), or
# CLEAR_TIME earlier ("time"); one in the same direction stays CLEARANCE aside, or the host
# CLEAR_TIME behind.
ENDINGS = ("hit", "space", "time")
STOPS = "stop"  # who crosses stops CLEARANCE before the host's side: until then, a collision course
AVOIDED = "avoided"  # a collision course, but the host's driver brakes when warned

# Speeds of the host (km/h); the other's speed and size are in the makers below.
PROTOCOLS = {
    "pedestrian_near": (20, 30, 40, 50, 60),
    "pedestrian_far": (20, 30, 40, 50, 60),
    "child_behind_cars": (20, 30, 40, 50),
    "cyclist_across": (20, 30, 40, 50),
    "cyclist_along": (30, 40, 50, 60),
    "car_standing": (20, 30, 40, 50),
    "car_slower": (30, 40, 50, 60),
    "car_braking_12_2": (50,),
    "car_braking_12_6": (50,),
    "car_braking_40_2": (50,),
    "car_braking_40_6": (50,),
    "turn_across_30": (10, 15, 20),
    "turn_across_45": (10, 15, 20),
    "turn_across_60": (10, 15, 20),
}


CROSSING = ("pedestrian_near", "pedestrian_far", "child_behind_cars", "cyclist_across")


def encounters(endings=ENDINGS):
    """Returns all of them (list of Encounter)."""
    return [
        Encounter(protocol, float(speed), ending)
        for protocol, speeds in PROTOCOLS.items()
        for speed in speeds
        for ending in endings
        if ending != STOPS or protocol in CROSSING
    ]


def scene(encounter, seed=1):
    """Returns the scene (dict) as in a yaml file of the simulator."""
    kind, _, variant = encounter.protocol.partition("_")
    host = encounter.host * KMH
    makers = {
        "pedestrian": _pedestrian, "child": _child, "cyclist": _cyclist, "car": _car, "turn": _turn,
    }  # fmt: skip
    result = _street(host, seed)
    avoided = encounter.ending == AVOIDED
    makers[kind](result, host, variant, "hit" if avoided else encounter.ending)
    if avoided:
        _brake(result, host)
    return result


def _brake(result, host):
    """The host brakes at 6 m/s^2, and stops 2 m before they would have met."""
    begin = MEETING - 0.5 * host / 6.0 - 2.0 / host
    result["ego"]["speed"] = [[0.0, host], [begin, host], [begin + host / 6.0, 0.0]]


def _street(host, seed):
    """Houses and parked cars on both sides; the host drives straight."""
    return {
        "options": {"seed": seed, "duration": MEETING + AFTER, "contact": True},
        "roads": [{"name": "main", "points": [[ROAD[0], 0.0], [ROAD[1], 0.0]], "width": 12.0}],
        "ego": {"path": [[0.0, HOST_Y], [ROAD[1], HOST_Y]], "speed": [[0.0, host]]},
        "rows": [
            {"road": "main", "side": "left", "kinds": ["car", "van"], "from": 0.0, "to": 370.0,
             "spacing": 8.0, "from_curb": 2.5},
        ],
        "fronts": [
            {"road": "main", "side": side, "from": 0.0, "to": 370.0, "piece": piece, "gap": 4.0,
             "from_curb": from_curb}
            for side, piece, from_curb in (("left", 19.0, 6.0), ("right", 22.0, 12.0))
        ],
        "actors": [],
    }  # fmt: skip


def _meeting_x(host):
    """Returns the bumper's position (m) when they meet."""
    return host * MEETING + FRONT


def _crossing(result, host, speed, kind, side, ending):
    """A road user crosses the host's lane from the right (side -1) or the left (1), and is in front
    of the middle of the bumper at MEETING."""
    half = {"pedestrian": 0.25, "cyclist": 0.9}[kind]
    deceleration = {"pedestrian": 2.0, "cyclist": 3.0}[kind]
    x = _meeting_x(host) + (0.25 if kind == "pedestrian" else 0.3)
    run_up = 14.0 if kind == "cyclist" else 5.0 if side < 0.0 else 8.0  # m from the lane's middle
    start_y = HOST_Y + side * run_up
    wait = MEETING - run_up / speed
    if ending in ("space", "time"):  # it has left the lane when the bumper arrives
        wait -= (HALF_WIDTH + half) / speed
        wait -= CLEAR_TIME if ending == "time" else CLEARANCE / speed
    profile = _start_at(wait, speed)
    # It stops before the lane, or beyond it.
    distance = run_up - HALF_WIDTH - half - CLEARANCE if ending == STOPS else run_up + BEYOND
    profile = _stop_after(profile, distance, speed, deceleration)
    result["actors"].append(
        {"kind": kind, "path": [[x, start_y], [x, HOST_Y - side * 60.0]],
         "start": max(0.0, -wait * speed), "speed": profile, "corner_radius": 0.0}
    )  # fmt: skip


def _start_at(wait, speed):
    """It stands, and starts at `wait` (s); if that is at most 0.1 s, it moves from the begin."""
    if wait <= 0.1:
        return [[0.0, speed]]
    ramp = min(0.4, wait)
    # Half of the ramp's distance is lost: it starts that much earlier.
    return [[0.0, 0.0], [wait - 0.5 * ramp, 0.0], [wait + 0.5 * ramp, speed]]


def _stop_after(profile, distance, speed, deceleration):
    """The same, but it stops after `distance` (m)."""
    braking = speed * speed / (2.0 * deceleration)
    begin = profile[-1][0] + max(0.0, (distance - braking) / speed)
    if len(profile) > 1:  # the distance of the ramp up
        begin -= 0.5 * (profile[-1][0] - profile[-2][0])
    begin = max(begin, profile[-1][0] + 0.05)
    return profile + [[begin, speed], [begin + speed / deceleration, 0.0]]


def _pedestrian(result, host, variant, ending):
    side, speed = (-1.0, 5.0 * KMH) if variant == "near" else (1.0, 8.0 * KMH)
    _crossing(result, host, speed, "pedestrian", side, ending)


def _child(result, host, _, ending):
    """Between parked cars on the near side, visible late."""
    # Through the gap between two cars, which are 4.4 m long and 6.2 m apart from middle to middle.
    first = _meeting_x(host) - ROAD[0] + 0.25 - 4.5 * 6.2
    result["rows"].append(
        {"road": "main", "side": "right", "kinds": ["car"], "from": first, "to": first + 6 * 6.2, "spacing": 6.2,
         "from_curb": -1.2}
    )  # fmt: skip
    _crossing(result, host, 5.0 * KMH, "pedestrian", -1.0, ending)


def _cyclist(result, host, variant, ending):
    if variant == "across":
        _crossing(result, host, 15.0 * KMH, "cyclist", -1.0, ending)
        return
    speed = 15.0 * KMH
    offset = 0.0 if ending == "hit" else HALF_WIDTH + 0.3 + CLEARANCE
    if ending == "time":  # as far ahead as the host needs to slow down to the other's speed
        _follow(result, host, speed, "cyclist")
        return
    rear = _meeting_x(host) - speed * MEETING
    _ahead(result, "cyclist", rear + 0.4, HOST_Y - offset, [[0.0, speed]])


def _ahead(result, kind, x, y, profile):
    """A road user in the host's direction; its rear axle is at x at the start."""
    result["actors"].append({"kind": kind, "path": [[x, y], [ROAD[1] + 200.0, y]], "speed": profile})


def _follow(result, host, speed, kind):
    """The host slows down at 2 m/s^2 and stays CLEAR_TIME behind."""
    slowing = (host - speed) / 2.0
    closing = 0.5 * (host - speed) * slowing
    begin = MEETING - 3.0
    gap = CLEAR_TIME * max(speed, 2.0) + closing + (host - speed) * begin
    overhang = {"cyclist": 0.4, "car": 0.85}[kind]
    _ahead(result, kind, FRONT + gap + overhang, HOST_Y, [[0.0, speed]])
    result["ego"]["speed"] = [[0.0, host], [begin, host], [begin + slowing, speed]]


def _car(result, host, variant, ending):
    what, *numbers = variant.split("_")
    lateral = 2.0 * HALF_WIDTH + CLEARANCE if ending == "space" else 0.0
    if what == "braking":
        _braking_car(result, host, float(numbers[0]), float(numbers[1]), ending, lateral)
        return
    speed = 0.0 if what == "standing" else 20.0 * KMH
    if ending == "time":
        _follow(result, host, speed, "car")
        return
    rear = _meeting_x(host) - speed * MEETING
    _ahead(result, "car", rear + 0.85, HOST_Y + lateral, [[0.0, speed]])


def _braking_car(result, host, distance, deceleration, ending, lateral):
    """50 behind 50 km/h; it brakes to a standstill. Without a reaction they collide; if the ending
    is in time, the host's driver brakes, too."""
    begin = 3.0
    stop = begin + host / deceleration
    profile = [[0.0, host], [begin, host], [stop, 0.0]]
    _ahead(result, "car", FRONT + distance + 0.85, HOST_Y + lateral, profile)
    result["options"]["duration"] = stop + AFTER + 4.0
    if ending == "time":
        reaction = 0.6
        result["ego"]["speed"] = [[0.0, host], [begin + reaction, host],
                                  [begin + reaction + host / (deceleration + 1.5), 0.0]]  # fmt: skip


def _turn(result, host, variant, ending):
    """The host turns left across the lane of an oncoming car."""
    speed = float(variant.rsplit("_", 1)[1]) * KMH
    corner = 60.0
    radius = 8.0
    result["roads"].append({"name": "side", "points": [[corner, -60.0], [corner, 90.0]], "width": 10.0})
    result["ego"]["path"] = [[0.0, HOST_Y], [corner + 2.0, HOST_Y], [corner + 2.0, 90.0]]
    result["ego"]["corner_radius"] = radius
    # On the arc the bumper reaches the other lane's middle, y = 2, after about this length.
    turned = math.acos(1.0 - (2.0 - HOST_Y) / (radius + FRONT * 0.9))
    length = corner + 2.0 - radius + radius * turned
    start = max(0.0, length - host * MEETING)
    result["ego"]["start"] = start
    meeting = (length - start) / host
    x = corner + 2.0 - radius + radius * math.sin(turned) + FRONT * math.cos(turned)
    # In space: it has just passed. In time: it comes later.
    passed = -6.4 - speed * (CORNER_LEAD + CLEARANCE) / host
    shift = {"hit": 0.0, "space": passed, "time": speed * (CLEAR_TIME + 1.2)}[ending]
    begin = x + 2.2 + speed * meeting + shift
    result["actors"].append(
        {"kind": "car", "path": [[begin, 2.0], [begin - 400.0, 2.0]], "speed": [[0.0, speed]]}
    )
    result["options"]["duration"] = meeting + 1.5
    result["rows"] = []
    result["fronts"] = [
        {"road": "main", "side": side, "from": first, "to": last, "piece": 20.0, "gap": 4.0,
         "from_curb": 6.0}
        for side in ("left", "right") for first, last in ((0.0, 105.0), (135.0, 370.0))
    ]  # fmt: skip
