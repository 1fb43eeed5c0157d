// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/frozen_sensor.h"

#include <cstddef>

#include <gtest/gtest.h>

namespace datmo::frozen_sensor_test {
namespace {

sensor_msgs::LaserScan uniformScan(float range) {
  constexpr std::size_t kBeams = 181;
  sensor_msgs::LaserScan scan;
  scan.range_min = 0.1F;
  scan.range_max = 80.0F;
  scan.ranges.assign(kBeams, range);
  return scan;
}

TEST(MeasuredBytes, AreThoseOfWhatCameBack) {
  EXPECT_FALSE(measuredBytes(uniformScan(20.0F)).empty());
}

TEST(MeasuredBytes, NothingComesBackFromBeyondTheReach) {
  EXPECT_TRUE(measuredBytes(uniformScan(81.83F)).empty()) << "an empty square is not frozen";
  EXPECT_TRUE(measuredBytes(uniformScan(0.0F)).empty());
}

}  // namespace
}  // namespace datmo::frozen_sensor_test
