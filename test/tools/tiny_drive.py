# SPDX-License-Identifier: BSD-3-Clause
"""A KITTI raw drive of a few frames, made up so that everything in it can be worked out by hand.

The car drives 1 m per frame (10 m/s, 10 Hz) straight east. All mounts are simple: the Velodyne is
0.8 m ahead of the IMU and 0.8 m above it, the camera faces ahead from the Velodyne's position.
"""

import struct
from pathlib import Path

FRAMES = 4
WIDTH, HEIGHT = 8, 4
FOCAL, BASELINE = 10.0, 0.5
METER_IN_LONGITUDE = 180.0 / (3.141592653589793 * 6378137.0)  # degrees, at the equator

CAM_TO_CAM = f"""\
calib_time: 09-Jan-2012 13:57:47
S_rect_00: {WIDTH} {HEIGHT}
R_rect_00: 1 0 0 0 1 0 0 0 1
P_rect_00: {FOCAL} 0 4 0 0 {FOCAL} 2 0 0 0 1 0
S_rect_01: {WIDTH} {HEIGHT}
R_rect_01: 1 0 0 0 1 0 0 0 1
P_rect_01: {FOCAL} 0 4 {-FOCAL * BASELINE} 0 {FOCAL} 2 0 0 0 1 0
"""
IMU_TO_VELO = "R: 1 0 0 0 1 0 0 0 1\nT: -0.8 0 -0.8\n"
VELO_TO_CAM = "R: 0 -1 0 0 0 -1 1 0 0\nT: 0 0 0\n"

TRACKLET = """\
<boost_serialization><tracklets><count>1</count><item_version>1</item_version><item>
<objectType>Van</objectType><h>2</h><w>2</w><l>4</l><first_frame>0</first_frame>
<poses><count>{count}</count>{poses}</poses></item></tracklets></boost_serialization>
"""
TRACKLET_POSE = (
    "<item><tx>{x}</tx><ty>0</ty><tz>-1.73</tz><rx>0</rx><ry>0</ry><rz>0</rz>"
    "<state>2</state><occlusion>1</occlusion><truncation>0</truncation></item>"
)


def make_drive(root, frames=FRAMES, points=((10.0, 0.0, -1.23, 0.5),), van_x=12.0, van_step=0.0):
    """Makes the drive below `root` (a folder's name) and returns its folder.

    points: of every cloud; van_x: where the van's center stands in the first cloud, m ahead, and
    van_step: how much further ahead it is from frame to frame.
    """
    folder = Path(root) / "2011_09_26" / "2011_09_26_drive_0001_sync"
    for kind in ("oxts", "velodyne_points", "image_00", "image_01"):
        (folder / kind / "data").mkdir(parents=True)
        stamps = (f"2011-09-26 13:04:32.{100 * frame:03d}000000\n" for frame in range(frames))
        (folder / kind / "timestamps.txt").write_text("".join(stamps))
    (folder.parent / "calib_cam_to_cam.txt").write_text(CAM_TO_CAM)
    (folder.parent / "calib_imu_to_velo.txt").write_text(IMU_TO_VELO)
    (folder.parent / "calib_velo_to_cam.txt").write_text(VELO_TO_CAM)
    for frame in range(frames):
        cloud = b"".join(struct.pack("<4f", *point) for point in points)
        (folder / "velodyne_points" / "data" / f"{frame:010d}.bin").write_bytes(cloud)
        (folder / "oxts" / "data" / f"{frame:010d}.txt").write_text(oxts_line(frame))
        write_png(folder / "image_00" / "data" / f"{frame:010d}.png", 10 + frame)
        write_png(folder / "image_01" / "data" / f"{frame:010d}.png", 20 + frame)
    poses = "".join(TRACKLET_POSE.format(x=van_x + frame * van_step) for frame in range(frames))
    (folder / "tracklet_labels.xml").write_text(TRACKLET.format(count=frames, poses=poses))
    return folder


def make_extract(root, frames=FRAMES, motion_per_frame=10):
    """The same drive as it is published unsynchronized and unrectified; returns its folder.

    Clouds are text, the GPS/IMU has its own rate, images are larger and distorted by nothing: the
    raw camera sees one pixel more on each side.
    """
    sync = make_drive(root, frames)
    folder = sync.with_name(sync.name.replace("_sync", "_extract"))
    sync.rename(folder)
    (folder / "tracklet_labels.xml").unlink()
    for path in (folder / "velodyne_points" / "data").iterdir():
        points = struct.iter_unpack("<4f", path.read_bytes())
        text = "".join(" ".join(f"{value:.3f}" for value in point) + "\n" for point in points)
        path.with_suffix(".txt").write_text(text)
        path.unlink()
    records = (frames - 1) * motion_per_frame + 1
    stamps = (1000 * number // motion_per_frame * 100 for number in range(records))
    lines = (f"2011-09-26 13:04:32.{stamp:06d}000\n" for stamp in stamps)
    (folder / "oxts" / "timestamps.txt").write_text("".join(lines))
    for number in range(records):
        line = oxts_line(number / motion_per_frame)
        (folder / "oxts" / "data" / f"{number:010d}.txt").write_text(line)
    _make_raw_images(folder)
    return folder


def _make_raw_images(folder):
    calibration = folder.parent / "calib_cam_to_cam.txt"
    raw = "".join(
        f"S_{camera}: {WIDTH + 2} {HEIGHT + 2}\nD_{camera}: 0 0 0 0 0\n"
        f"K_{camera}: {FOCAL} 0 5 0 {FOCAL} 3 0 0 1\n"
        for camera in ("00", "01")
    )
    calibration.write_text(calibration.read_text() + raw)
    for camera in ("image_00", "image_01"):
        for path in (folder / camera / "data").iterdir():
            write_png(path, 30, WIDTH + 2, HEIGHT + 2)


def oxts_line(frame, speed=10.0, yaw=0.0, yaw_rate=0.0):
    """A record of the GPS/IMU `frame` meters east of longitude 8 on the equator."""
    fields = [0.0] * 30
    fields[1] = 8.0 + frame * METER_IN_LONGITUDE
    fields[5], fields[8], fields[22] = yaw, speed, yaw_rate
    return " ".join(repr(field) for field in fields)


def write_png(path, gray, width=WIDTH, height=HEIGHT):
    """Writes a gray image whose pixels are all `gray`, except for the first one: 0."""
    import cv2
    import numpy as np

    pixels = np.full((height, width), gray, np.uint8)
    pixels[0, 0] = 0
    cv2.imwrite(str(path), pixels)
