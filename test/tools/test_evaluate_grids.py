#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate grids on grids and drives that are worked out by hand."""

import math
import unittest

import numpy as np
import rosbag
from datmo_tools import bag_messages, transforms
from datmo_tools.evaluate.grid_scores import Bodies, Echoes, Grid, GridScores, StereoView, Tally
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import CameraInfo, LaserEcho, LaserScan, MultiEchoLaserScan
from tf2_msgs.msg import TFMessage

from datmo_fusion.msg import TrueEchoes, TrueObject, TrueObjectArray
from evaluate_case import EvaluateCase

SECOND = 10**9
START = 1000 * SECOND
BODY, CURB, PAINT = TrueEchoes.BODY, TrueEchoes.CURB, TrueEchoes.PAINT
EDGES = [0.0, 10.0, 20.0, 36.0]

# The optical axes (x right, y down, z forward) in a vehicle's (x forward, y left, z up).
OPTICAL = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
# 1.3 m above the origin, 45 deg to each side, depth uncertain by 2 m at 20 m.
VIEW = StereoView(transforms.rigid(OPTICAL, [0.0, 0.0, 1.3]), (-1.0, 1.0), 36.0, 0.005)

# 50 x 40 cells of 1 m, ahead of the vehicle.
ROWS, COLUMNS = 40, 50
ORIGIN = np.array([0.0, -20.0])


def cells_with(*points):
    """Returns free cells, but occupied where the points (x, y) are."""
    cells = np.full((ROWS, COLUMNS), 20, dtype=np.int8)
    for x, y in points:
        cells[math.floor(y + 20.0), math.floor(x)] = 80
    return cells


def grid(*points):
    return Grid(1.0, ORIGIN, cells_with(*points))


def echoes(*items):
    """Returns echoes of (x, y, surface)."""
    items = np.array(items).reshape(-1, 3)
    return Echoes(items[:, :2], items[:, 2].astype(int))


def bodies(*items):
    """Returns bodies of (x, y, yaw, length, width, height)."""
    items = np.array(items, dtype=float).reshape(-1, 6)
    return Bodies(items[:, :3], items[:, 3:5], items[:, 5])


class View(unittest.TestCase):
    def assert_hidden(self, point, hidden, *items):
        self.assertEqual(VIEW.hidden(np.array([point]), bodies(*items)).tolist(), [hidden])

    def test_behind_a_car(self):
        """4 m long across the road, 2 m wide: from x = 9 to 11 m, y = -1 to 3 m."""
        car = (10.0, 1.0, math.pi / 2, 4.0, 2.0, 1.5)
        for point, hidden in (((20.0, 0.0), True), ((20.0, 5.3), True), ((20.0, 6.9), False),
                              ((20.0, -2.3), False), ((8.0, 0.0), False), ((9.9, 0.0), False),
                              ((10.1, 0.0), True), ((-20.0, 0.0), False)):
            self.assert_hidden(point, hidden, car)
        self.assert_hidden((20.0, 0.0), True, (10.0, 30.0, 0.0, 4.0, 2.0, 1.5), car)
        self.assert_hidden((20.0, 0.0), False)

    def test_behind_a_low_obstacle(self):
        """The line of sight to 20 m is 0.65 m high above x = 10 m."""
        self.assert_hidden((20.0, 0.0), False, (10.0, 0.0, 0.0, 0.1, 2.0, 0.6))
        self.assert_hidden((20.0, 0.0), True, (10.0, 0.0, 0.0, 0.1, 2.0, 0.7))

    def test_ranges(self):
        points = [(3.0, 4.0), (4.0, 3.0), (3.0, 4.1), (-4.0, 0.0), (36.1, 0.0), (35.0, 0.0)]
        expected = [math.inf, 5.0, math.inf, math.inf, math.inf, 35.0]
        np.testing.assert_allclose(VIEW.ranges(np.array(points)), expected)

    def test_camera_beside_the_middle(self):
        view = VIEW._replace(camera_in_base=transforms.rigid(OPTICAL, [2.0, 1.0, 1.3]))
        np.testing.assert_allclose(view.ranges(np.array([(5.0, 3.9), (5.0, -1.9), (5.0, 4.1)])),
                                   [math.hypot(3.0, 2.9)] * 2 + [math.inf])


class Scores(unittest.TestCase):
    def scores(self, lidar, fused, found=(), poles=(), standing=()):
        result = GridScores(VIEW, EDGES)
        poles = np.array(poles, dtype=float).reshape(-1, 2)
        result.add(lidar, fused, echoes(*found), bodies(*standing), poles)
        return result

    def assert_tally(self, tally, having, total):
        self.assertEqual((tally.having.tolist(), tally.total.tolist()), (having, total))

    def test_paint_that_is_gone(self):
        near, far, aside = (8.5, 0.5), (25.5, 0.5), (3.5, 15.5)
        found = [(*position, PAINT) for position in (near, far, aside)]
        scores = self.scores(grid(near, far, aside), grid(near), found)
        self.assert_tally(scores.paint_gone, [2, 1, 0, 0, 1], [3, 2, 1, 0, 1])
        self.assert_tally(scores.bodies_lost, [0] * 5, [0] * 5)

    def test_bodies_that_are_lost(self):
        positions = (8.5, 0.5), (15.5, 0.5), (38.5, 0.5)
        found = [(*position, BODY) for position in positions]
        scores = self.scores(grid(*positions), grid((8.5, 0.5)), found)
        self.assert_tally(scores.bodies_lost, [2, 1, 0, 1, 0], [3, 2, 1, 1, 0])

    def test_cells_that_do_not_count(self):
        """Curbs; paint in the cell of a body; cells that the lidar's grid does not have;
        one cell twice."""
        found = [(8.5, 0.5, PAINT), (8.7, 0.3, BODY), (9.5, 0.5, CURB), (10.5, 0.5, PAINT),
                 (12.1, 0.5, PAINT), (12.2, 0.5, PAINT), (55.0, 0.5, PAINT)]
        scores = self.scores(grid((8.5, 0.5), (9.5, 0.5), (12.5, 0.5)), grid(), found)
        self.assert_tally(scores.paint_gone, [1, 1, 0, 1, 0], [1, 1, 0, 1, 0])
        self.assert_tally(scores.bodies_lost, [1, 1, 1, 0, 0], [1, 1, 1, 0, 0])

    def test_hidden_cells_are_not_in_view(self):
        positions = (8.5, 0.5), (15.5, 0.5)
        scores = self.scores(grid(*positions), grid(), [(*position, PAINT) for position in positions],
                             standing=[(12.0, 0.5, 0.0, 4.0, 2.0, 1.5)])
        self.assert_tally(scores.paint_gone, [2, 1, 1, 0, 0], [2, 1, 1, 0, 0])

    def test_undecided_is_not_occupied(self):
        fused = grid()
        fused.cells[20, 8:10] = 50, -1
        positions = (8.5, 0.5), (9.5, 0.5)
        scores = self.scores(grid(*positions), fused, [(*position, BODY) for position in positions])
        self.assert_tally(scores.bodies_lost, [2, 2, 2, 0, 0], [2, 2, 2, 0, 0])

    def test_poles(self):
        """Along the line of sight as far as the depth is uncertain, across it one cell."""
        for cell, pole, held in (
            ((9.5, 0.5), (9.5, 0.5), True),
            ((10.5, 0.5), (9.5, 0.5), True),  # one cell, though sigma is 0.45 m
            ((11.5, 0.5), (9.5, 0.5), False),
            ((21.9, 0.5), (20.4, 0.5), True),  # sigma is 2.1 m
            ((22.9, 0.5), (20.4, 0.5), False),
            ((20.5, 2.5), (20.4, 0.5), False),
        ):
            scores = self.scores(grid(), grid(cell), poles=[pole])
            band = 0 if pole[0] < 10.0 else 2
            total = [1, 1] + [int(i == band) for i in range(3)]
            having = total if held else [0] * 5
            self.assert_tally(scores.poles_in_fused, having, total)
            self.assert_tally(scores.poles_in_lidar, [0] * 5, total)

    def test_pole_at_the_grids_border(self):
        scores = self.scores(grid((0.5, 0.5)), grid(), poles=[(0.2, 0.1)])
        self.assert_tally(scores.poles_in_lidar, [1, 1, 1, 0, 0], [1, 1, 1, 0, 0])

    def test_percent(self):
        tally = Tally(EDGES)
        tally.add(np.array([5.0, 5.0, math.inf]), np.array([True, False, False]))
        np.testing.assert_allclose(tally.percent(), [100 / 3, 50.0, 50.0, math.nan, math.nan])


def stamped(message_type, time, frame, **fields):
    """Returns a message with a header at `time` (s after START)."""
    stamp = START + round(time * SECOND)
    return message_type(header=bag_messages.header(stamp, frame), **fields)


def mount(frame, z, turn):
    message = TransformStamped(header=bag_messages.header(START, "base_link"), child_frame_id=frame)
    message.transform.translation = Vector3(0.0, 0.0, z)
    message.transform.rotation = Quaternion(*turn)
    return message


def camera_info(baseline_term):
    projection = [100.0, 0.0, 100.0, baseline_term, 0.0, 100.0, 50.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    return stamped(CameraInfo, 0, "stereo_left_optical", width=201, height=101, P=projection)


def pole(x, y, *visible_to):
    item = TrueObject(id=1, label="Pole", visible_to=visible_to)
    item.pose.position.x, item.pose.position.y = x, y
    item.pose.orientation.w = 1.0
    return item


class Tool(EvaluateCase):
    """Beams at -0.1, 0, 0.1 rad: a body at 9 m, paint at 15 m, nothing."""

    RANGES = (9.0, 15.0, math.inf)
    SURFACES = (BODY, PAINT, TrueEchoes.NOTHING)
    POSITIONS = ((9.0 * math.cos(0.1), -9.0 * math.sin(0.1)), (15.0, 0.0))

    def setUp(self):
        super().setUp()
        self.run_bag, self.drive = self.folder / "run.bag", self.folder / "drive.bag"

    def write(self, path, *messages):
        with rosbag.Bag(str(path), "w") as bag:
            for topic, message in messages:
                header = message.transforms[0].header if topic == "/tf_static" else message.header
                bag.write(topic, message, header.stamp)

    def drive_messages(self, surfaces=SURFACES, echoes_as=LaserScan):
        """The vehicle is at (100, 50) in the map and faces along its y axis."""
        sides = {"angle_min": -0.1, "angle_increment": 0.1}
        ranges = self.RANGES
        if echoes_as is MultiEchoLaserScan:
            ranges = [LaserEcho([value] if math.isfinite(value) else []) for value in self.RANGES]
        pose = bag_messages.planar_odometry(START, "map", "base", (100.0, 50.0, math.pi / 2), 0, 0)
        poles = [pole(95.0, 62.0, "scanner", "stereo"), pole(100.0, 62.0, "scanner")]
        return [
            ("/tf_static", TFMessage([mount("scanner", 0.45, (0.0, 0.0, 0.0, 1.0)),
                                      mount("stereo_left_optical", 1.3, (-0.5, 0.5, -0.5, 0.5))])),
            ("/stereo/left/camera_info", camera_info(0.0)),
            ("/stereo/right/camera_info", camera_info(-50.0)),
            ("/scan" if echoes_as is LaserScan else "/echoes",
             stamped(echoes_as, 0, "scanner", ranges=ranges, **sides)),
            ("/ground_truth/pose", pose),
            ("/ground_truth/objects", stamped(TrueObjectArray, 0, "map", objects=poles)),
            ("/ground_truth/echoes",
             stamped(TrueEchoes, 0, "scanner", surfaces=bytes(surfaces), objects=[0] * 3,
                     ranges=[0.0] * 3)),
        ]

    def grid_message(self, *points, time=0.0, cell_size=1.0):
        message = stamped(OccupancyGrid, time, "base_link", data=cells_with(*points).ravel())
        message.info.resolution, message.info.width, message.info.height = cell_size, COLUMNS, ROWS
        message.info.origin.position.x, message.info.origin.position.y = ORIGIN
        message.info.origin.orientation.w = 1.0
        return message

    def score(self, *options, code=0):
        return self.evaluate("grids", self.run_bag, self.drive, *options, code=code)

    def test_both_kinds_of_scan(self):
        self.write(self.run_bag, ("/grids/lidar", self.grid_message(*self.POSITIONS)),
                   ("/grids/fused", self.grid_message(self.POSITIONS[0], (12.5, 5.5))))
        for kind in (LaserScan, MultiEchoLaserScan):
            self.write(self.drive, *self.drive_messages(echoes_as=kind))
            out, _, figures = self.score()
            self.assertEqual(figures["scans_scored"], 1)
            self.assertEqual(figures["columns"][2:], ["0-10 m", "10-20 m", "20-36 m"])
            self.assertEqual(figures["paint_gone"]["count"], [1, 1, 0, 1, 0])
            self.assertEqual(figures["paint_gone"]["percent"], [100.0, 100.0, None, 100.0, None])
            self.assertEqual(figures["bodies_lost"]["count"], [0] * 5)
            self.assertEqual(figures["bodies_lost"]["of"], [1, 1, 1, 0, 0])
            # The pole is 12 m ahead and 5 m to the left.
            self.assertEqual(figures["poles_in_fused"]["count"], [1, 1, 0, 1, 0])
            self.assertEqual(figures["poles_in_lidar"]["of"], [1, 1, 0, 1, 0])
            self.assertEqual(figures["poles_in_lidar"]["count"], [0] * 5)
            self.assertIn("100.0% of 1", out)

    def test_scan_that_takes_time(self):
        """The middle beam is measured 0.05 s later, when the vehicle is 1 m further ahead."""
        messages = self.drive_messages()
        messages[3][1].time_increment = 0.05
        messages[4][1].twist.twist.linear.x = 20.0
        self.write(self.drive, *messages)
        self.write(self.run_bag, ("/grids/lidar", self.grid_message((16.0, 0.0))),
                   ("/grids/fused", self.grid_message()))
        self.assertEqual(self.score()[2]["paint_gone"]["of"][0], 1)

    def test_only_stamps_that_all_have(self):
        self.write(self.drive, *self.drive_messages())
        lidar = [("/grids/lidar", self.grid_message(time=time)) for time in (0.0, 0.1)]
        fused = [("/grids/fused", self.grid_message(time=time)) for time in (0.1, 0.2)]
        self.write(self.run_bag, *lidar, *fused)
        self.assertIn("no stamp with both /grids/lidar and /grids/fused", self.score(code=1)[1])
        self.write(self.run_bag, *lidar, *fused, ("/grids/fused", self.grid_message()))
        self.assertEqual(self.score()[2]["scans_scored"], 1)

    def test_bad_input(self):
        grids = [(topic, self.grid_message()) for topic in ("/grids/lidar", "/grids/fused")]
        self.write(self.run_bag, *grids)
        good = self.drive_messages()
        for messages, text in (
            (good[1:], "/tf_static has no base_link -> stereo_left_optical"),
            (good[:2] + good[3:], "nothing on /stereo/right/camera_info"),
            (good[:-1], "no scan with /ground_truth/echoes"),
            (self.drive_messages(surfaces=(BODY,)), "has 1 beams, the scan 3"),
            (good[:2] + [("/stereo/right/camera_info", camera_info(0.0))] + good[3:], "P[3] = 0"),
        ):
            self.write(self.drive, *messages)
            self.assertIn(text, self.score(code=1)[1])
        self.write(self.drive, *good)
        self.write(self.run_bag, grids[0], ("/grids/fused", self.grid_message(cell_size=0.5)))
        self.assertIn("expected the same window", self.score(code=1)[1])
        self.write(self.run_bag, grids[0], ("/grids/fused", good[-2][1]))
        self.assertIn("expected nav_msgs/OccupancyGrid", self.score(code=1)[1])
        self.assertIn("--effective-range is -1", self.score("--effective-range", "-1", code=1)[1])
        self.run_bag.write_text("no bag")
        self.assertIn("is not a bag", self.score(code=1)[1])


if __name__ == "__main__":
    unittest.main()
