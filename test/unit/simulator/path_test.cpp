// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/path.h"

#include <cmath>
#include <stdexcept>

#include "simulator/speed_profile.h"
#include <gtest/gtest.h>

namespace datmo::simulator::path_test {
namespace {

TEST(Path, StraightLine) {
  const Path path({{0.0, 0.0}, {3.0, 4.0}}, 1.0);
  EXPECT_DOUBLE_EQ(path.length(), 5.0);
  EXPECT_NEAR(path.at(2.5).pose.x(), 1.5, 1e-12);
  EXPECT_NEAR(path.at(2.5).pose.y(), 2.0, 1e-12);
  EXPECT_NEAR(path.at(2.5).pose.heading(), std::atan2(4.0, 3.0), 1e-12);
  EXPECT_EQ(path.at(2.5).curvature, 0.0);
}

TEST(Path, CornerToTheLeftBecomesAnArc) {
  // Radius 2: the arc begins 2 m before the corner and is pi long.
  const Path path({{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}}, 2.0);
  EXPECT_NEAR(path.length(), 8.0 + kPi + 8.0, 1e-12);
  const PathPoint middle = path.at(8.0 + kPi / 2.0);
  EXPECT_NEAR(middle.pose.x(), 8.0 + std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(middle.pose.y(), 2.0 - std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(middle.pose.heading(), kPi / 4.0, 1e-12);
  EXPECT_NEAR(middle.curvature, 0.5, 1e-12);
  EXPECT_NEAR(path.at(path.length()).pose.y(), 10.0, 1e-12);
}

TEST(Path, CornerToTheRightTurnsNegative) {
  const Path path({{0.0, 0.0}, {10.0, 0.0}, {10.0, -10.0}}, 2.0);
  EXPECT_NEAR(path.at(9.0).curvature, -0.5, 1e-12);
  EXPECT_NEAR(path.at(path.length()).pose.heading(), -kPi / 2.0, 1e-12);
}

TEST(Path, ShortLegMakesTheArcSmaller) {
  const Path path({{0.0, 0.0}, {2.0, 0.0}, {2.0, 10.0}}, 5.0);
  EXPECT_NEAR(path.at(1.5).curvature, 1.0, 1e-12);
}

TEST(Path, ContinuesStraightBeyondItsEnds) {
  const Path path({{0.0, 0.0}, {10.0, 0.0}}, 0.0);
  EXPECT_DOUBLE_EQ(path.at(-3.0).pose.x(), -3.0);
  EXPECT_DOUBLE_EQ(path.at(12.0).pose.x(), 12.0);
}

TEST(Path, ArcLengthIsLengthAlongThePath) {
  const Path path({{0.0, 0.0}, {20.0, 0.0}, {30.0, 15.0}, {10.0, 30.0}}, 4.0);
  constexpr double kStep = 1e-3;
  for (double arc_length = 0.0; arc_length + kStep < path.length(); arc_length += 0.05) {
    const Pose2 before = path.at(arc_length).pose;
    const Pose2 after = path.at(arc_length + kStep).pose;
    EXPECT_NEAR((after.position() - before.position()).norm(), kStep, 1e-8);
    EXPECT_LE(std::abs(angleBetween(before.heading(), after.heading())), kStep / 4.0 + 1e-9);
  }
}

TEST(Path, BadInputIsRefused) {
  EXPECT_THROW(Path({{0.0, 0.0}}, 1.0), std::invalid_argument);
  EXPECT_THROW(Path({{0.0, 0.0}, {0.0, 0.0}}, 1.0), std::invalid_argument);
  EXPECT_THROW(Path({{0.0, 0.0}, {5.0, 0.0}, {0.0, 0.0}}, 1.0), std::invalid_argument);
  EXPECT_THROW(Path({{0.0, 0.0}, {5.0, 0.0}}, -1.0), std::invalid_argument);
}

TEST(SpeedProfile, BrakesEvenly) {
  const SpeedProfile profile({{2.0, 10.0}, {4.0, 0.0}});
  EXPECT_DOUBLE_EQ(profile.speed(1.0), 10.0);
  EXPECT_DOUBLE_EQ(profile.speed(3.0), 5.0);
  EXPECT_DOUBLE_EQ(profile.speed(9.0), 0.0);
  EXPECT_DOUBLE_EQ(profile.distance(2.0), 20.0);
  EXPECT_DOUBLE_EQ(profile.distance(3.0), 27.5);
  EXPECT_DOUBLE_EQ(profile.distance(9.0), 30.0);
}

TEST(SpeedProfile, DistanceIsTheIntegralOfSpeed) {
  const SpeedProfile profile({{0.0, 3.0}, {1.5, 8.0}, {2.0, 8.0}, {6.0, 0.5}});
  double sum = 0.0;
  constexpr double kStep = 1e-3;
  for (int i = 0; i < 8000; ++i) {
    sum += kStep * profile.speed((i + 0.5) * kStep);
  }
  EXPECT_NEAR(profile.distance(8.0), sum, 1e-6);
}

TEST(SpeedProfile, BadInputIsRefused) {
  EXPECT_THROW(SpeedProfile({}), std::invalid_argument);
  EXPECT_THROW(SpeedProfile({{0.0, -1.0}}), std::invalid_argument);
  EXPECT_THROW(SpeedProfile({{1.0, 2.0}, {1.0, 3.0}}), std::invalid_argument);
}

}  // namespace
}  // namespace datmo::simulator::path_test
