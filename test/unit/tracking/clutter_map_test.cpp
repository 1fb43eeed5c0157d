// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/clutter_map.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace datmo::clutter_map_test {
namespace {

class ClutterMapTest : public testing::Test {
 protected:
  double area() const { return options_.cell_size * options_.cell_size; }

  ClutterMapOptions options_;
  ClutterMap map_{options_};
  const Point2 position_{12.0, -7.0};
};

TEST_F(ClutterMapTest, IsUnknownInitially) { EXPECT_EQ(map_.density(position_), 0.0); }

TEST_F(ClutterMapTest, OneObjectInEachScanBecomesOneByArea) {
  for (int i = 0; i < 1000; ++i) {
    map_.learn({position_}, 0.1);
  }
  EXPECT_NEAR(map_.density(position_), 1.0 / area(), 1e-3 / area());
  EXPECT_EQ(map_.density(position_), map_.density(Point2(18.0, -1.0))) << "the same cell";
  EXPECT_EQ(map_.density(Point2(22.0, -7.0)), 0.0) << "the next cell";
}

TEST_F(ClutterMapTest, TimeCountsNotTheNumberOfScans) {
  ClutterMap quick(options_);
  for (int i = 0; i < 40; ++i) {
    quick.learn({position_}, 0.05);
  }
  map_.learn({position_}, 2.0);
  EXPECT_NEAR(quick.density(position_), map_.density(position_), 1e-12);
  EXPECT_NEAR(map_.density(position_), (1.0 - std::exp(-2.0 / options_.learning_time)) / area(),
              1e-12);
}

TEST_F(ClutterMapTest, ForgetsWithTheSameTimeConstant) {
  map_.learn({position_, position_}, 3.0);
  const double before = map_.density(position_);
  map_.learn({}, options_.learning_time);
  EXPECT_NEAR(map_.density(position_), before * std::exp(-1.0), 1e-12);
}

TEST_F(ClutterMapTest, NoTimeTeachesNothing) {
  map_.learn({position_}, 0.0);
  EXPECT_EQ(map_.density(position_), 0.0);
}

TEST_F(ClutterMapTest, DistantOrNanPositionsAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  map_.learn({Point2(1e300, 0.0), Point2(nan, nan), Point2(options_.range + 1.0, 0.0)}, 1.0);
  EXPECT_EQ(map_.density(Point2(1e300, 0.0)), 0.0);
  EXPECT_EQ(map_.density(Point2(options_.range + 1.0, 0.0)), 0.0);
  EXPECT_EQ(map_.density(Point2(options_.range - 1.0, 0.0)), 0.0);
}

TEST_F(ClutterMapTest, ClearForgetsAll) {
  map_.learn({position_}, 1.0);
  EXPECT_GT(map_.density(position_), 0.0);
  map_.clear();
  EXPECT_EQ(map_.density(position_), 0.0);
}

}  // namespace
}  // namespace datmo::clutter_map_test
