#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate maps and changes on maps and boxes that are counted by hand."""

import math
import unittest

import numpy as np
import rosbag
from border_samples import parked, write_drive
from datmo_tools import bag_messages, transforms
from datmo_tools.evaluate.grid_recordings import seen_from
from datmo_tools.evaluate.grid_scores import Grid
from datmo_tools.evaluate.map_scores import Boxes, Moment, boxes_from, count
from datmo_tools.stamps import to_ros_time
from evaluate_case import EvaluateCase
from nav_msgs.msg import MapMetaData, OccupancyGrid
from track_samples import DRIFT, PERIOD, START

CELL = 0.5
SIDE = 120  # cells: 30 m to each side
ORIGIN = np.full(2, -30.0)
NO_BOXES = Boxes(np.zeros((0, 3)), np.zeros((0, 2)))

# 4 m long and 2 m wide: x from 8 to 12 m, y from 2 to 4 m.
CAR = (10.0, 3.0, 0.0, 4.0, 2.0)


def grid(occupied=(), free=(), percents=(90, 10)):
    cells = np.full((SIDE, SIDE), -1, dtype=np.int8)
    for points, percent in zip((occupied, free), percents):
        for x, y in points:
            cells[math.floor((y + 30.0) / CELL), math.floor((x + 30.0) / CELL)] = percent
    return Grid(CELL, ORIGIN, cells)


def moment(standing=(), resting=(), seen=None, thin=None):
    number = len(standing)
    return Moment(
        boxes_from((0.0, 0.0, 0.0), standing), boxes_from((0.0, 0.0, 0.0), resting),
        np.array([True] * number if seen is None else seen, dtype=bool),
        np.array([False] * number if thin is None else thin, dtype=bool),
        lambda points: np.abs(points[:, 1]) < 5.0,
    )  # fmt: skip


def add_map(run, topic, frame, occupied, free, percents=(90, 10)):
    """Adds a map to a run that write_drive has written; points in the true map."""
    in_map = [
        [transforms.compose(DRIFT, (x, y, 0.0))[:2] for x, y in points] for points in (occupied, free)
    ]
    cells = grid(*in_map, percents)
    stamp = START + frame * PERIOD
    message = OccupancyGrid(header=bag_messages.header(stamp, "map"))
    message.info = MapMetaData(resolution=CELL, width=SIDE, height=SIDE)
    message.info.origin.position.x = message.info.origin.position.y = ORIGIN[0]
    message.data = cells.cells.ravel().tolist()
    with rosbag.Bag(run, "a") as bag:
        bag.write(topic, message, to_ros_time(stamp))


class Counting(unittest.TestCase):
    def test_cells_on_or_next_to_an_obstacle_are_right(self):
        seen = count(grid([(8.2, 2.2), (7.7, 2.2), (7.2, 2.2), (15.2, 0.2)]), moment([CAR]))
        self.assertEqual((seen.occupied, seen.occupied_right), (4, 2))
        self.assertEqual((seen.things, seen.things_found), (1, 1))

    def test_beyond_the_road_nothing_is_evaluated(self):
        seen = count(grid([(8.2, 6.2)], [(8.2, -6.2)]), moment())
        self.assertEqual((seen.occupied, seen.free), (0, 0))

    def test_free_inside_an_obstacle_is_wrong_but_not_on_its_side(self):
        seen = count(grid(free=[(10.2, 3.2), (8.2, 3.2), (5.2, 3.2)]), moment([CAR]))
        self.assertEqual((seen.free, seen.free_right), (3, 2))
        self.assertEqual((seen.things, seen.things_found), (1, 0))

    def test_objects_that_move_later_are_left_out(self):
        self.assertEqual(count(grid([(8.2, 2.2)]), moment(resting=[CAR])).occupied, 0)

    def test_unseen_and_distant_obstacles_are_not_required(self):
        pole = (30.5, 0.0, 0.0, 0.2, 0.2)
        seen = count(grid(), moment([CAR, pole], seen=[False, True]))
        self.assertEqual((seen.things, seen.things_found), (0, 0))

    def test_poles_are_separate_obstacles(self):
        poles = [(5.0, 0.0, 0.0, 0.2, 0.2), (5.0, 4.0, 0.0, 0.2, 0.2)]
        seen = count(grid([(5.2, 0.2)]), moment([*poles, CAR], thin=[True, True, False]))
        self.assertEqual((seen.poles, seen.poles_found, seen.things), (2, 1, 3))

    def test_a_turned_box(self):
        """Turned by 90 degrees: x from 9 to 11 m, y from 1 to 5 m."""
        turned = Boxes(np.array([[10.0, 3.0, math.pi / 2]]), np.array([[4.0, 2.0]]))
        depths = turned.depths(np.array([[10.0, 4.5], [12.0, 3.0]]))
        np.testing.assert_allclose(depths[:, 0], [-0.5, 1.0], atol=1e-9)
        self.assertEqual(NO_BOXES.nearest(np.array([[0.0, 0.0]])).tolist(), [math.inf])


class Seen(unittest.TestCase):
    def test_a_map_from_a_pose_in_it(self):
        """The vehicle at (4, 2), facing along y: (4, 8) is 6 m ahead."""
        seen = seen_from(grid([(4.2, 8.2)]), (4.0, 2.0, math.pi / 2))
        rows, columns = np.nonzero(seen.cells > 50)
        self.assertEqual(len(rows), 1)
        center = seen.centers(np.column_stack([columns, rows]))[0]
        np.testing.assert_allclose(center, [6.25, -0.25], atol=1e-9)


class CommandLine(EvaluateCase):
    def write_run(self, occupied, free):
        """A run with truth, and one map; points in the true map. It drives along x, a car is parked at
        x from 13 to 17 m, y from 2 to 4 m."""
        run = self.folder / "run.bag"
        write_drive(run, None, objects=[parked(1, 15.0, 3.0)])
        add_map(run, "/map/fused", 10, occupied, free)
        return run

    def test_a_map_is_scored_where_the_run_takes_it_to_be(self):
        run = self.write_run([(13.2, 2.2), (18.2, 0.2)], [(15.2, 3.2), (12.2, 0.2), (12.2, 4.7)])
        text, _, result = self.evaluate("maps", run, run)
        self.assertEqual((result["occupied"], result["occupied_right"]), (2, 1))
        self.assertEqual((result["free"], result["free_right"]), (2, 1), "one is at the curb")
        self.assertEqual((result["things"], result["things_found"], result["poles"]), (1, 1, 0))
        self.assertIsNone(result["conflicts"])
        self.assertIn("1 maps", text)

    def test_unscorable_maps_are_reported(self):
        run = self.write_run([], [])
        _, errors, _ = self.evaluate("maps", run, run, "--topic", "/map/other", code=1)
        self.assertIn("no grid on /map/other", errors)


class Changes(EvaluateCase):
    """Car 1 is gone, cars 3 and 4 are new; the vehicle passes all but the last one."""

    def write_drives(self):
        run, before = self.folder / "run.bag", self.folder / "before.bag"
        write_drive(before, None, objects=[parked(1, 10.0, 3.0), parked(2, 10.0, -3.0)])
        objects = [parked(7, 10.0, -3.0), parked(3, 3.0, 3.0), parked(4, 19.0, 3.0)]
        write_drive(run, None, objects=objects)
        return run, before

    def test_cells_and_obstacles_are_counted(self):
        run, before = self.write_drives()
        vanished = [(10.2, 2.2), (11.2, 2.2), (10.2, -2.2)]  # one of a car that is still there
        add_map(run, "/map/changes", 20, [(15.2, 0.2)], vanished, (100, 0))
        text, _, result = self.evaluate("changes", run, run, before)
        self.assertEqual(result["vanished"], {"cells": 3, "cells_right": 2, "things": 1,
                                              "things_reported": 1, "wrong_cells": 1.0})
        self.assertEqual(result["new"], {"cells": 1, "cells_right": 0, "things": 1,
                                         "things_reported": 0, "wrong_cells": 1.0})
        self.assertIn("vanished", text)

    def test_changes_before_passing_are_not_required(self):
        run, before = self.write_drives()
        add_map(run, "/map/changes", 10, [], [(10.2, 2.2)], (100, 0))
        _, _, result = self.evaluate("changes", run, run, before)
        self.assertEqual(result["vanished"]["things"], 0)
        self.assertEqual(result["vanished"]["cells_right"], 1)

    def test_a_run_without_changes_is_refused(self):
        run, before = self.write_drives()
        _, errors, _ = self.evaluate("changes", run, run, before, code=1)
        self.assertIn("no grid on /map/changes", errors)


if __name__ == "__main__":
    unittest.main()
