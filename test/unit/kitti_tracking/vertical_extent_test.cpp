// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/vertical_extent.h"

#include <gtest/gtest.h>

namespace datmo::kitti::vertical_extent_test {
namespace {

const VerticalExtentOptions kOptions;

TEST(VerticalExtentTest, BeginsWithTheFirstDetection) {
  const VerticalExtent vertical(1.7, 1.5, kOptions);
  EXPECT_EQ(vertical.bottom(), 1.7);
  EXPECT_EQ(vertical.height(), 1.5);
}

TEST(VerticalExtentTest, TheHeightIsTheMean) {
  VerticalExtent vertical(1.7, 1.4, kOptions);
  for (const double height : {1.6, 1.5, 1.7}) {
    vertical.predict(0.1, kOptions);
    vertical.update(1.7, height, kOptions);
  }
  EXPECT_NEAR(vertical.height(), 1.55, 1e-12);
}

TEST(VerticalExtentTest, TheLowerFaceFollowsTheRoad) {
  VerticalExtent vertical(1.7, 1.5, kOptions);
  for (int i = 1; i <= 30; ++i) {
    vertical.predict(0.1, kOptions);
    vertical.update(1.7 + 0.05 * i, 1.5, kOptions);
  }
  EXPECT_NEAR(vertical.bottom(), 3.2, 0.05);
}

TEST(VerticalExtentTest, AfterALongGapOnlyTheNewOneCounts) {
  VerticalExtent vertical(1.7, 1.5, kOptions);
  vertical.predict(100.0, kOptions);
  vertical.update(2.7, 1.5, kOptions);
  EXPECT_NEAR(vertical.bottom(), 2.7, 0.001);
}

}  // namespace
}  // namespace datmo::kitti::vertical_extent_test
