#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""evaluate draw_borders on small bags whose borders are worked out by hand."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import numpy as np
import rosbag
import rospy
from datmo_tools.evaluate.border_images import draw_image
from datmo_tools.evaluate.border_lists import SeenBorder
from datmo_tools.evaluate.border_recordings import Run, edge
from datmo_tools.evaluate.outlines import corners
from datmo_tools.evaluate.border_views import FAINTEST, line_style, opacity, title
from datmo_tools.evaluate.camera_images import read_images
from datmo_tools.errors import InputError
from datmo_tools.evaluate.main import main
from datmo_tools.evaluate.nearest_messages import nearest_messages, stamps_of
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from datmo_fusion.msg import RoadBorder
from border_run_samples import START, STEP, border, write_images, write_run

CAMERA = "/stereo/left"


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.bag, self.drive = self.folder / "run.bag", self.folder / "drive.bag"

    def assert_points(self, points, expected):
        np.testing.assert_allclose(points, expected, atol=1e-5)


class NearestMessages(Folder):
    def test_one_for_each_stamp_within_the_tolerance(self):
        write_images(self.drive, count=3, delay=0)
        topic = f"{CAMERA}/image_rect"
        self.assertEqual(stamps_of(self.drive, topic), [START, START + STEP, START + 2 * STEP])
        stamps = [START - STEP, START + STEP // 3, START + 2 * STEP]
        found = nearest_messages(self.drive, [topic], stamps, STEP // 2)[topic]
        self.assertEqual({stamp: image.data[0] for stamp, image in found.items()},
                         {stamps[1]: 0, stamps[2]: 2})  # fmt: skip
        self.assertEqual(list(nearest_messages(self.drive, [topic], stamps)[topic]), [stamps[2]])


class Recordings(Folder):
    def moment(self, time, history=0.0):
        run = Run(self.bag)
        return run.moments(run.nearest_stamps([time]), history)[0]

    def test_moment(self):
        """After 0.5 s the vehicle is 5 m up the map's y axis, straight ahead of where it was."""
        write_run(self.bag)
        moment = self.moment(0.52)
        self.assertEqual((moment.stamp, moment.time), (START + 5 * STEP, 0.5))
        self.assert_points(moment.base, [0.0, 5.0, np.pi / 2])
        self.assert_points(moment.borders[0].points, [(-4.0, -10.0), (-4.0, 50.0)])
        sides = [item.side for item in moment.borders]
        self.assertEqual(sides, ["left", "right"])
        self.assert_points(moment.points, [(10.0, 0.0)])
        self.assert_points(moment.moving[0].mean(axis=0), (10.0, 0.0))
        self.assert_points(moment.others[0].mean(axis=0), (20.0, 0.0))
        self.assert_points(moment.dropped[0].mean(axis=0), (5.0, -3.0))
        self.assertEqual(len(moment.earlier), 0)

    def test_earlier_scans_are_drawn_where_they_were_seen(self):
        """10 m ahead of the vehicle's pose at that time,
        which was 1 m back for each scan that has passed."""
        write_run(self.bag)
        self.assert_points(self.moment(0.5, history=0.2).earlier, [(8.0, 0.0), (9.0, 0.0)])
        self.assertEqual(len(self.moment(0.1, history=0.2).earlier), 1)

    def test_truth_is_seen_from_the_true_pose(self):
        """The map has drifted by 3 m; the true curb is 4 m to the left of the true vehicle."""
        write_run(self.bag)
        truth = self.moment(0.5).truth
        self.assert_points(truth.borders[0], [(-5.0, 4.0), (35.0, 4.0)])
        self.assertIn("WRONG", title(self.moment(0.5)))
        write_run(self.bag, truth=False)
        self.assertIsNone(self.moment(0.5).truth)
        self.assertNotIn("WRONG", title(self.moment(0.5)))

    def test_times(self):
        write_run(self.bag)
        run = Run(self.bag)
        self.assertEqual(run.nearest_stamps([0.31, 0.0, 0.29]), [START, START + 3 * STEP])
        for time in (-0.1, 1.2):
            with self.assertRaisesRegex(InputError, "expected 0 to 1.00 s"):
                run.nearest_stamps([time])

    def test_malformed_border(self):
        for points in ([(0.0, 0.0)], []):
            write_run(self.bag, borders=[border(RoadBorder.LEFT, points)])
            with self.assertRaisesRegex(InputError, "with .* points and .* sigmas, expected"):
                self.moment(0.0)
        unlike = border(RoadBorder.LEFT, [(0.0, 0.0), (1.0, 0.0)])
        unlike.sigma = [0.1]
        write_run(self.bag, borders=[unlike])
        with self.assertRaisesRegex(InputError, "2 points and 1 sigmas"):
            self.moment(0.0)


class Lines(unittest.TestCase):
    def test_edges_of_a_border_are_perpendicular_to_it(self):
        item = SeenBorder("left", np.array([(0.0, 0.0), (0.0, 4.0), (0.0, 8.0)]),
                          np.array([0.1, 0.2, 0.3]), 0.9, 0.0)  # fmt: skip
        expected = [(-0.2, 0.0), (-0.4, 4.0), (-0.6, 8.0)]
        np.testing.assert_allclose(edge(item, 2.0), expected, atol=1e-9)

    def test_corners_of_a_box(self):
        found = corners(np.array([1.0, 2.0, np.pi / 2]), np.array([4.0, 2.0]))
        self.assertEqual({tuple(row) for row in found.round(6)},
                         {(0.0, 4.0), (0.0, 0.0), (2.0, 0.0), (2.0, 4.0)})  # fmt: skip

    def test_style(self):
        item = SeenBorder("left", np.zeros((2, 2)), np.zeros(2), 1.0, 0.5)
        self.assertEqual((opacity(item), line_style(item)), (1.0, "-"))
        item = item._replace(probability=0.0, unseen=1.5)
        self.assertEqual((opacity(item), line_style(item)), (FAINTEST, "--"))
        self.assertEqual(line_style(item._replace(side_street=True)), ":")


class Images(Folder):
    def test_positions_on_the_road(self):
        """Focal length 100, middle 50, 40, 1.5 m above the road."""
        write_images(self.drive)
        image = read_images(self.drive, CAMERA, [START])[START]
        self.assertEqual(image.stamp, START + STEP // 4)
        self.assert_points(image.camera.road_pixels(np.array([(10.0, 2.0), (20.0, -4.0)])),
                           [(30.0, 55.0), (70.0, 47.5)])  # fmt: skip
        self.assertTrue(np.isnan(image.camera.road_pixels(np.array([(0.5, 0.0), (-10.0, 0.0)]))).all())

    def test_each_stamp_has_its_image(self):
        write_images(self.drive)
        stamps = [START + 2 * STEP, START + 7 * STEP, START + 50 * STEP]
        found = read_images(self.drive, CAMERA, stamps)
        self.assertEqual({stamp: image.pixels[0, 0] for stamp, image in found.items()},
                         {stamps[0]: 2, stamps[1]: 7})  # fmt: skip

    def test_border_is_drawn_at_its_position(self):
        """4 m to the left and 20 m ahead is 20 pixels to the left of the middle and 7.5 below."""
        write_run(self.bag)
        write_images(self.drive)
        moment = Run(self.bag).moments([START], 0.0)[0]
        moment = moment._replace(borders=moment.borders[:1])
        figure = Figure(figsize=(1.0, 0.8), dpi=100)
        canvas = FigureCanvasAgg(figure)
        image = read_images(self.drive, CAMERA, [START])[START]
        draw_image(figure.add_axes([0.0, 0.0, 1.0, 1.0]), image, moment, (0.0, 0.0, np.pi / 2))
        canvas.draw()
        red, _, blue, _ = np.moveaxis(np.asarray(canvas.buffer_rgba()).astype(int), -1, 0)
        colored = blue > red + 50
        self.assertTrue(colored[47:49, 30].any())
        self.assertFalse(colored[:, 75:].any() or colored[:30].any())

    def test_bad_input(self):
        write_images(self.drive, encoding="16UC1")
        with self.assertRaisesRegex(InputError, "an image is 16UC1, expected one of mono8"):
            read_images(self.drive, CAMERA, [START])
        with self.assertRaisesRegex(InputError, "nothing on /mono/image_rect"):
            read_images(self.drive, "/mono", [START])


class Tool(Folder):
    def draw(self, *words, code=0, bag=None):
        """Returns the tool's standard error; its sheets are named out*.png."""
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors):
            arguments = ["draw_borders", str(bag or self.bag), "--out", str(self.folder / "out.png"), *words]
            self.assertEqual(main(arguments), code, errors.getvalue())
        return errors.getvalue()

    def sheets(self):
        return sorted(path.name for path in self.folder.glob("*.png"))

    def test_sheets(self):
        """Two views per row, seen from above; one with images. The same
        input gives the same bytes."""
        write_run(self.bag)
        self.draw("--at", "0.2,0.5")
        self.assertEqual(self.sheets(), ["out.png"])
        first = (self.folder / "out.png").read_bytes()
        self.draw("--at", "0.2,0.5")
        self.assertEqual((self.folder / "out.png").read_bytes(), first)
        self.draw("--every", "0.4", "--rows", "1")
        self.assertEqual(self.sheets(), ["out.png", "out_1.png", "out_2.png"])
        write_images(self.drive)
        self.draw("--every", "0.4", "--rows", "1", "--images", str(self.drive))
        self.assertEqual(self.sheets()[-1], "out_3.png")

    def test_bad_input(self):
        self.assertIn("no such file", self.draw(code=1))
        write_images(self.bag)
        self.assertIn("nothing on /road_borders", self.draw(code=1))
        write_run(self.bag)
        self.assertIn("no borders at 5 s, expected 0 to 1.00 s", self.draw("--at", "5", code=1))
        self.assertIn("--every is 0, expected more", self.draw("--every", "0", code=1))
        self.assertIn("--history is -1", self.draw("--history", "-1", code=1))
        self.assertIn("a name that ends in", self.draw("--out", "picture.jpg", code=1))
        only = self.folder / "only.bag"
        with rosbag.Bag(str(self.bag)) as bag, rosbag.Bag(str(only), "w") as out:
            first = rospy.Time(START // 10**9)
            for topic, message, stamp in bag.read_messages():
                if topic != "/road_borders" or message.header.stamp == first:
                    out.write(topic, message, stamp)
        self.assertIn("all borders have one stamp, expected two or more, or --at 0", self.draw(code=1, bag=only))
        write_images(self.drive, delay=100 * STEP)
        said = self.draw("--images", str(self.drive), code=1)
        self.assertIn("no image with a stamp near", said)
        self.assertEqual(self.sheets(), [])


if __name__ == "__main__":
    unittest.main()
