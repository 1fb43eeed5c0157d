#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate free_cells on grids and clouds that are counted by hand."""

import math
import unittest

import numpy as np
from datmo_tools import bag_messages, transforms
from datmo_tools.bag_file import whole_bag
from datmo_tools.convert import kitti_messages
from datmo_tools.convert.kitti_calibration import Camera
from datmo_tools.evaluate import camera_images
from datmo_tools.evaluate.free_cells import Image, count
from datmo_tools.evaluate.grid_scores import Grid
from evaluate_case import EvaluateCase
from geometry_msgs.msg import Pose, Quaternion
from nav_msgs.msg import MapMetaData, OccupancyGrid
from tf2_msgs.msg import TFMessage

START = 1000 * 10**9

# The optical axes (x right, y down, z forward) in a vehicle's (x forward, y left, z up), 1.7 m above
# the road; the road is in the image from 1.7 * 100 / 50 = 3.4 m on.
OPTICAL = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
MOUNT = transforms.rigid(OPTICAL, [0.0, 0.0, 1.7])
PROJECTION = np.array([[100.0, 0.0, 100.0, 0.0], [0.0, 100.0, 50.0, 0.0], [0.0, 0.0, 1.0, 0.0]])
IMAGE = Image(camera_images.Camera(transforms.inverse(MOUNT), PROJECTION), (201, 100))

# 60 x 40 cells of half a meter, ahead of the vehicle.
ROWS, COLUMNS, CELL = 40, 60, 0.5
ORIGIN = np.array([0.0, -10.0])


def grid(*free, others=-1):
    """Returns cells free where the points (x, y) are, the rest with the percentage `others`."""
    cells = np.full((ROWS, COLUMNS), others, dtype=np.int8)
    for x, y in free:
        cells[math.floor((y + 10.0) / CELL), math.floor(x / CELL)] = 20
    return Grid(CELL, ORIGIN, cells)


def totals(seen, road=(), obstacles=()):
    """Returns for all bands: free of which is known, right, road, found."""
    points = [np.array(each, dtype=float).reshape(-1, 2) for each in (obstacles, road)]
    return tuple(int(column.sum()) for column in count(seen, *points, IMAGE))


class Counting(unittest.TestCase):
    def test_free_road_is_right_and_found(self):
        self.assertEqual(totals(grid((6.1, 0.1)), road=[(6.2, 0.2)]), (1, 1, 1, 1))

    def test_free_obstacle_is_wrong_also_with_road_in_its_cell(self):
        self.assertEqual(totals(grid((6.1, 0.1)), [(6.2, 0.2)], [(6.3, 0.3)]), (1, 0, 0, 0))

    def test_cells_unknown_to_the_velodyne_are_not_counted(self):
        self.assertEqual(totals(grid((6.1, 0.1))), (0, 0, 0, 0))

    def test_unknown_undecided_and_occupied_road_is_not_found(self):
        for others in (-1, 50, 80):
            self.assertEqual(totals(grid(others=others), road=[(6.2, 0.2)]), (0, 0, 1, 0))

    def test_cells_outside_the_image_are_left_out(self):
        for point in ((3.1, 0.1), (6.1, 6.6), (26.0, 0.1)):
            self.assertEqual(totals(grid(point), road=[point]), (0, 0, 0, 0), point)


class Tool(EvaluateCase):
    def setUp(self):
        super().setUp()
        velodyne = transforms.rigid(np.eye(3), [0.0, 0.0, 1.73])
        mounts = ((kitti_messages.VELODYNE, velodyne), (kitti_messages.LEFT_CAMERA, MOUNT))
        road = [(x + 0.25, y + 0.25, -1.73, 0.0) for x in range(3, 40) for y in range(-8, 8)]
        with whole_bag(self.folder / "drive.bag", "test") as bag:
            bag.write("/tf_static", START, TFMessage([
                bag_messages.transform(START, "base_link", frame, mount,
                                       transforms.quaternion_of(mount[:3, :3]))
                for frame, mount in mounts]))  # fmt: skip
            bag.write("/stereo/left/camera_info", START,
                      kitti_messages.camera_info(START, Camera(PROJECTION, 201, 100)))  # fmt: skip
            for stamp in (START, START + 10**8):
                bag.write("/ground_truth/pose", stamp, bag_messages.planar_odometry(
                    stamp, "map", "base_link", np.zeros(3), 0.0, 0.0))  # fmt: skip
                bag.write("/points", stamp, kitti_messages.point_cloud(stamp, np.array(road)))
        message = OccupancyGrid(header=bag_messages.header(START, "base_link"))
        message.info = MapMetaData(resolution=CELL, width=COLUMNS, height=ROWS)
        message.info.origin = Pose(orientation=Quaternion(w=1.0))
        message.info.origin.position.x, message.info.origin.position.y = ORIGIN
        message.data = grid((6.1, 0.1), (7.1, 0.1)).cells.ravel().tolist()
        with whole_bag(self.folder / "run.bag", "test") as bag:
            bag.write("/grids/mono", START, message)

    def run_tool(self, *words, code=0):
        bags = [self.folder / name for name in ("run.bag", "drive.bag")]
        return self.evaluate("free_cells", *bags, *words, code=code)

    def test_bands(self):
        out, errors, score = self.run_tool()
        self.assertEqual(errors, "")
        bands = {(band["from"], band["to"]): band for band in score["bands"]}
        self.assertEqual(bands[(5.0, 10.0)]["free"], 2)
        self.assertEqual(bands[(0.0, 20.0)]["precision"], 1.0)
        self.assertGreater(bands[(0.0, 20.0)]["road"], 100)
        self.assertIsNone(bands[(10.0, 15.0)]["precision"])
        self.assertIn("1 grids, 0 more without a cloud", out)

    def test_missing_topics_are_named(self):
        self.assertIn("of 0 grids on /grids/lidar", self.run_tool("--topic", "/grids/lidar", code=1)[1])


if __name__ == "__main__":
    unittest.main()
