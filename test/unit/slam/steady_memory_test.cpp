// SPDX-License-Identifier: BSD-3-Clause
// How often a step of the SLAM allocates memory.

#include <algorithm>
#include <cstddef>

#include "allocation_count.h"
#include "yard.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/slam/grid_slam.h"

namespace datmo::slam_memory_test {
namespace {

constexpr double kPeriod = 0.1;      // s
constexpr Twist2 kCircle{4.0, 0.8};  // m/s, rad/s: a lap takes 79 scans
constexpr int kWarmUp = 80;          // scans
constexpr int kScans = 80;
const Pose2 kStart(9.0, -3.0, 0.0);

TEST(SlamMemory, AStepTakesAFewAllocationsForAScan) {
  const Yard yard;
  GridSlam slam{GridSlamOptions()};
  std::size_t most = 0;
  for (int i = 0; i < kWarmUp + kScans; ++i) {
    const double seconds = kPeriod * i;
    const Scan scan = yard.scan(kStart * arc(kCircle, seconds), seconds);
    const std::size_t before = allocationCount();
    slam.addOdometry({scan.stamp, kCircle});
    const bool accepted = slam.process(scan).match.accepted;
    EXPECT_TRUE(accepted || i == 0);
    if (i >= kWarmUp) {
      most = std::max(most, allocationCount() - before);
    }
  }
  // Each list has its size from the start: it does not grow with the beams.
  EXPECT_LT(most, 18U) << "15: the lists of one scan, and at times a piece of odometry";
}

}  // namespace
}  // namespace datmo::slam_memory_test
