// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/kitti_calibration.h"

#include "text_file.h"
#include <gtest/gtest.h>

namespace datmo::kitti::kitti_calibration_test {
namespace {

const std::string kTwelve = " 1 2 3 4 5 6 7 8 9 10 11 12\n";
const std::string kNine = " 1 2 3 4 5 6 7 8 9\n";

TEST(KittiCalibration, MatricesAreRowByRow) {
  const TextFolder folder("kitti_calibration_test");
  const Calibration calibration = readCalibration(
      folder.write("0000.txt", "P0: 1 2\nP2:" + kTwelve + "R0_rect:" + kNine +
                                   "Tr_velo_to_cam:" + kTwelve + "Tr_imu_to_velo:" + kTwelve));
  EXPECT_EQ(calibration.image_from_camera(0, 3), 4.0);
  EXPECT_EQ(calibration.image_from_camera(2, 0), 9.0);
  EXPECT_EQ(calibration.rectification(1, 0), 4.0);
  EXPECT_EQ(calibration.camera_from_velodyne(1, 1), 6.0);
  EXPECT_EQ(calibration.velodyne_from_imu(2, 3), 12.0);
}

TEST(KittiCalibration, NamesOfTheTrackingBenchmark) {
  const TextFolder folder("kitti_calibration_test");
  const Calibration calibration =
      readCalibration(folder.write("0000.txt", "P2:" + kTwelve + "R_rect" + kNine + "Tr_velo_cam" +
                                                   kTwelve + "Tr_imu_velo" + kTwelve));
  EXPECT_EQ(calibration.rectification(2, 2), 9.0);
}

TEST(KittiCalibration, NamesTheError) {
  const TextFolder folder("kitti_calibration_test");
  const std::string missing = folder.write("a.txt", "P2:" + kTwelve);
  EXPECT_EQ(messageOf([&] { readCalibration(missing); }),
            missing + ": has no R0_rect, expected a line of it");
  const std::string brief = folder.write("b.txt", "P2: 1 2 3\n");
  EXPECT_EQ(messageOf([&] { readCalibration(brief); }), brief + ":1: 4 columns, expected 13");
}

}  // namespace
}  // namespace datmo::kitti::kitti_calibration_test
