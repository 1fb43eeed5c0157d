#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate stereo_grids on grids and clouds that are counted by hand."""

import math
import unittest

import numpy as np
from datmo_tools import bag_messages, transforms
from datmo_tools.convert import kitti_messages
from datmo_tools.bag_file import whole_bag
from datmo_tools.evaluate.grid_scores import Grid, StereoView
from datmo_tools.convert.kitti_calibration import Camera
from datmo_tools.evaluate.stereo_grid_scores import NOTHING, CommonView, count, moved, obstacle_points
from geometry_msgs.msg import Pose, Quaternion
from nav_msgs.msg import MapMetaData, OccupancyGrid
from tf2_msgs.msg import TFMessage
from evaluate_case import EvaluateCase

MILLISECOND = 10**6
START = 1000 * 10**9

# The optical axes (x right, y down, z forward) in a vehicle's (x forward, y left, z up).
OPTICAL = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])

# The left camera at the vehicle's origin, 45 deg to each side; the right one 1 m beside it. The
# depth's standard deviation is a hundredth of its square: 1 m at 10 m.
LEFT = StereoView(transforms.rigid(OPTICAL, [0.0, 0.0, 1.7]), (-1.0, 1.0), 25.0, 0.01)
VIEW = CommonView(LEFT, 1.0, -1.0)

# 60 x 40 cells of half a meter, ahead of the vehicle.
ROWS, COLUMNS, CELL = 40, 60, 0.5
ORIGIN = np.array([0.0, -10.0])

# A level road (z = -1.73 m) of 1 m^2 to a point in the Velodyne's frame, enough for its plane.
ROAD = [(x + 0.5, y + 0.5, -1.73) for x in range(3, 40) for y in range(-8, 8)]


def grid(*points, others=20):
    """Returns cells occupied where the points (x, y) are, the rest with the percentage `others`."""
    cells = np.full((ROWS, COLUMNS), others, dtype=np.int8)
    for x, y in points:
        cells[math.floor((y + 10.0) / CELL), math.floor(x / CELL)] = 80
    return Grid(CELL, ORIGIN, cells)


def totals(seen, *obstacles):
    """Returns for all bands: occupied, right, true, found, reported free."""
    counts = count(seen, np.array(obstacles, dtype=float).reshape(-1, 2), VIEW)
    return tuple(int(column.sum()) for column in counts)


class Matching(unittest.TestCase):
    def test_same_cell_is_right(self):
        self.assertEqual(totals(grid((5.1, 0.1)), (5.2, 0.2)), (1, 1, 1, 1, 0))

    def test_next_cell_is_right_also_diagonally(self):
        self.assertEqual(totals(grid((3.1, 0.1)), (3.6, 0.6)), (1, 1, 1, 1, 0))

    def test_cell_after_the_next_is_wrong_where_the_depth_is_sure(self):
        self.assertEqual(totals(grid((3.1, 0.1)), (4.1, 0.1)), (1, 0, 1, 0, 1))

    def test_depth_that_is_unsure_is_allowed_for(self):
        # 16 m: 2.6 m; the cells are 2.5 m apart, then 3 m.
        self.assertEqual(totals(grid((16.1, 0.1)), (18.6, 0.1)), (1, 1, 1, 1, 0))
        self.assertEqual(totals(grid((13.1, 0.1)), (16.1, 0.1))[:2], (1, 0))

    def test_points_of_one_cell_count_once(self):
        self.assertEqual(totals(grid(), (5.1, 0.1), (5.2, 0.2))[2], 1)

    def test_unknown_is_missed_but_not_reported_free(self):
        self.assertEqual(totals(grid(others=-1), (5.1, 0.1)), (0, 0, 1, 0, 0))
        self.assertEqual(totals(grid(others=50), (5.1, 0.1)), (0, 0, 1, 0, 0))
        self.assertEqual(totals(grid(others=20), (5.1, 0.1)), (0, 0, 1, 0, 1))

    def test_empty_grid_and_empty_cloud(self):
        self.assertEqual(totals(grid()), (0, 0, 0, 0, 0))


class InView(unittest.TestCase):
    def test_bands_are_by_range_from_the_camera(self):
        counts = count(grid((3.1, 0.1), (12.1, 0.1), (14.6, 0.1)), np.zeros((0, 2)), VIEW)
        self.assertEqual(counts.occupied.tolist(), [1, 0, 2, 0, 0])

    def test_cells_seen_by_one_camera_only_are_left_out(self):
        # 5 m ahead the left camera sees 5 m to the left, the right one 4 m; both 5 m to the right.
        seen = [totals(grid((5.1, y)))[0] for y in (4.6, 3.9, -4.6, -5.9)]
        self.assertEqual(seen, [0, 1, 1, 0])

    def test_beyond_the_last_band_nothing_counts_but_serves_as_partner(self):
        self.assertEqual(totals(grid((25.6, 0.1))), (0, 0, 0, 0, 0))
        self.assertEqual(totals(grid((24.1, 0.1)), (26.1, 0.1)), (1, 1, 0, 0, 0))


class Clouds(unittest.TestCase):
    def test_obstacles_are_objects_on_the_road(self):
        heights = (0.0, 0.2, 0.4, 1.9, 2.1)
        cloud = np.array(ROAD + [(10.0, 5.0 + i, h - 1.73) for i, h in enumerate(heights)])
        base = transforms.rigid(np.eye(3), [1.0, 0.0, 1.73])
        np.testing.assert_allclose(obstacle_points(cloud, base), [(11.0, 7.0), (11.0, 8.0)])

    def test_recording_car_is_no_obstacle(self):
        cloud = np.array(ROAD + [(2.0, 0.0, -0.9), (2.9, 0.0, -0.9)])
        self.assertEqual(len(obstacle_points(cloud, np.eye(4))), 1)

    def test_stationary_obstacle_approaches_while_the_vehicle_drives(self):
        then, now = np.array([0.0, 0.0, 0.0]), np.array([2.0, 1.0, math.pi / 2])
        np.testing.assert_allclose(moved(np.array([[5.0, 1.0]]), then, now), [(0.0, -3.0)],
                                   atol=1e-9)  # fmt: skip


class Tool(EvaluateCase):
    """A drive at 10 m/s toward a post 10 m ahead of the first of two clouds."""

    def setUp(self):
        super().setUp()
        self.write_drive()
        self.write_run((START + 20 * MILLISECOND, (9.9, 0.1)))

    def write_drive(self, clouds=True):
        velodyne = transforms.rigid(np.eye(3), [0.0, 0.0, 1.73])
        mounts = ((kitti_messages.VELODYNE, velodyne),
                  (kitti_messages.LEFT_CAMERA, LEFT.camera_in_base))  # fmt: skip
        with whole_bag(self.folder / "drive.bag", "test") as bag:
            bag.write("/tf_static", START, TFMessage([
                bag_messages.transform(START, "base_link", frame, mount,
                                       transforms.quaternion_of(mount[:3, :3]))
                for frame, mount in mounts]))  # fmt: skip
            for side, term in (("left", 0.0), ("right", -100.0)):
                projection = np.array([[100.0, 0, 100, term], [0, 100, 50, 0], [0, 0, 1, 0]])
                bag.write(f"/stereo/{side}/camera_info", START,
                          kitti_messages.camera_info(START, Camera(projection, 201, 100)))  # fmt: skip
            for i in range(2):
                stamp = START + 100 * i * MILLISECOND
                pose = np.array([1.0 * i, 0.0, 0.0])
                bag.write("/ground_truth/pose", stamp,
                          bag_messages.planar_odometry(stamp, "map", "base_link", pose, 10.0, 0.0))  # fmt: skip
                cloud = np.array([(*point, 0.0) for point in (*ROAD, (10.1 - i, 0.1, -1.0))])
                if clouds:
                    bag.write("/points", stamp, kitti_messages.point_cloud(stamp, cloud))

    def write_run(self, *grids):
        """grids: stamp and position (x, y) of the one occupied cell."""
        with whole_bag(self.folder / "run.bag", "test") as bag:
            for stamp, position in grids:
                message = OccupancyGrid(header=bag_messages.header(stamp, "base_link"))
                message.info = MapMetaData(resolution=CELL, width=COLUMNS, height=ROWS)
                message.info.origin = Pose(orientation=Quaternion(w=1.0))
                message.info.origin.position.x, message.info.origin.position.y = ORIGIN
                message.data = grid(position).cells.ravel().tolist()
                bag.write("/grids/stereo", stamp, message)

    def run_tool(self, *words, code=0):
        bags = [self.folder / name for name in ("run.bag", "drive.bag")]
        return self.evaluate("stereo_grids", *bags, *words, code=code)

    def bands(self):
        _, errors, score = self.run_tool()
        self.assertEqual(errors, "")
        return {(band["from"], band["to"]): band for band in score["bands"]}

    def test_bands_and_sums(self):
        bands = self.bands()
        for ends in ((5.0, 10.0), (0.0, 15.0), (0.0, 25.0)):
            self.assertEqual(bands[ends]["precision"], 1.0, ends)
            self.assertEqual(bands[ends]["recall"], 1.0, ends)
        self.assertIsNone(bands[(0.0, 5.0)]["precision"])

    def test_table(self):
        out = self.run_tool()[0]
        self.assertRegex(out, r"0 to 15 m +1\.000 +1 +1\.000 +1 +0\.000")
        self.assertIn("1 grids, 0 more without a cloud", out)

    def test_grid_long_after_the_clouds_is_left_out(self):
        self.write_run((START, (9.9, 0.1)), (START + 300 * MILLISECOND, (9.9, 0.1)))
        self.assertIn("1 grids, 1 more without a cloud", self.run_tool()[0])

    def test_missing_topics_are_named(self):
        self.write_run((START + 10**10, (9.9, 0.1)))
        self.assertIn("of 1 grids on /grids/stereo none is within 0.1 s", self.run_tool(code=1)[1])
        self.write_drive(clouds=False)
        self.assertIn("nothing on /points", self.run_tool(code=1)[1])
        (self.folder / "run.bag").write_text("no bag")
        self.run_tool(code=1)

    def test_first_columns_may_be_left_out(self):
        self.assertRegex(self.run_tool("--first-column", "90")[0], r"0 to 15 m +1\.000 +1 ")
        out = self.run_tool("--first-column", "110")[0]
        self.assertRegex(out, r"0 to 15 m +- +0 +- +0 +-")  # the post is in column 99
        self.assertIn("--first-column is -1", self.run_tool("--first-column", "-1", code=1)[1])

    def test_sigma_must_be_more_than_nothing(self):
        self.assertIn("--disparity-sigma is 0", self.run_tool("--disparity-sigma", "0", code=1)[1])


class Sums(unittest.TestCase):
    def test_counts_add_up(self):
        one = count(grid((5.1, 0.1)), np.array([[5.2, 0.2]]), VIEW)
        self.assertEqual((NOTHING + one + one).right.tolist(), [0, 2, 0, 0, 0])


if __name__ == "__main__":
    unittest.main()
