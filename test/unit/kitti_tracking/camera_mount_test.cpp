// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/camera_mount.h"

#include "made_camera.h"
#include <gtest/gtest.h>

namespace datmo::kitti::camera_mount_test {
namespace {

TEST(CameraMountTest, TheCameraIsWhereTheCalibrationSays) {
  const Pose2 camera = madeCamera().cameraInBase();
  EXPECT_NEAR(camera.x(), 1.0, 1e-12);
  EXPECT_NEAR(camera.y(), -0.3, 1e-12);
  EXPECT_NEAR(camera.heading(), 0.0, 1e-12);
}

TEST(CameraMountTest, BoxesOnTheGround) {
  // 3 m to the right and 20 m ahead of the camera; at rotation 0 it points to the right.
  const Box2 box = madeCamera().onGround(boxAt(3.0, 20.0));
  EXPECT_NEAR(box.center.x(), 21.0, 1e-12);
  EXPECT_NEAR(box.center.y(), -3.3, 1e-12);
  EXPECT_NEAR(box.center.heading(), -kPi / 2.0, 1e-12);
  EXPECT_EQ(box.length, 4.0);
  EXPECT_EQ(box.width, 2.0);
}

TEST(CameraMountTest, RotationTurnsToTheRight) {
  const CameraMount mount = madeCamera();
  EXPECT_NEAR(std::abs(mount.onGround(boxAt(0.0, 10.0, kPi / 2.0)).center.heading()), kPi, 1e-12)
      << "toward the camera";
  EXPECT_NEAR(mount.onGround(boxAt(0.0, 10.0, -kPi / 2.0)).center.heading(), 0.0, 1e-12)
      << "away from it";
}

TEST(CameraMountTest, RoundTrip) {
  Calibration calibration = madeCalibration();
  // Turned by 3 degrees and moved.
  const double turn = degrees(3.0);
  calibration.velodyne_from_imu.leftCols<3>() << std::cos(turn), -std::sin(turn), 0, std::sin(turn),
      std::cos(turn), 0, 0, 0, 1;
  calibration.velodyne_from_imu.col(3) << -0.8, 0.3, -0.8;
  const CameraMount mount(calibration, {});
  for (const double rotation : {-3.0, -1.0, 0.4, 2.2}) {
    const Box3 box = boxAt(-5.0, 30.0, rotation);
    const Box3 back = mount.standing(mount.onGround(box), box.y, box.height);
    EXPECT_NEAR(back.x, box.x, 1e-9);
    EXPECT_NEAR(back.z, box.z, 1e-9);
    EXPECT_EQ(back.y, box.y);
    EXPECT_EQ(back.height, box.height);
    EXPECT_NEAR(angleBetween(back.rotation_y, rotation), 0.0, 1e-9);
  }
}

TEST(CameraMountTest, ImageOfABoxAhead) {
  // Its near side is 9 m away, from 1 m to the left to 1 m to the right, 0.1 to 1.6 m down.
  Box3 box = boxAt(0.0, 11.0, kPi / 2.0);
  const ImageBox image = madeCamera().inImage(box);
  EXPECT_NEAR(image.left, 600.0 - 700.0 / 9.0, 1e-9);
  EXPECT_NEAR(image.right, 600.0 + 700.0 / 9.0, 1e-9);
  EXPECT_NEAR(image.bottom, 180.0 + 700.0 * 1.6 / 9.0, 1e-9);
  EXPECT_NEAR(image.top, 180.0 + 700.0 * 0.1 / 13.0, 1e-9) << "of the far side";
  EXPECT_TRUE(madeCamera().isWithinImage(image));
}

TEST(CameraMountTest, ImagesAreCutAtTheBorders) {
  const CameraMount mount = madeCamera();
  const ImageBox image = mount.inImage(boxAt(9.0, 10.0));
  EXPECT_EQ(image.right, 1199.0);
  EXPECT_LT(image.left, image.right);
  EXPECT_FALSE(mount.isWithinImage(image));
  const ImageBox outside = mount.inImage(boxAt(30.0, 10.0));
  EXPECT_EQ(outside.left, outside.right);
}

TEST(CameraMountTest, TheFieldIsThatOfTheImage) {
  EXPECT_NEAR(madeCamera().maxBearing(), std::atan(600.0 / 700.0), 1e-12);
  EXPECT_NEAR(madeCamera().minBearing(), -std::atan(600.0 / 700.0), 1e-12);
}

TEST(CameraMountTest, AlphaIsTheRotationMinusTheViewingDirection) {
  EXPECT_NEAR(CameraMount::alpha(boxAt(10.0, 10.0, 1.0)), 1.0 - kPi / 4.0, 1e-12);
  EXPECT_NEAR(CameraMount::alpha(boxAt(0.0, 10.0, -2.0)), -2.0, 1e-12);
}

}  // namespace
}  // namespace datmo::kitti::camera_mount_test
