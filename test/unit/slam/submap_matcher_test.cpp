// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/submap_matcher.h"

#include "drift_drive.h"
#include <gtest/gtest.h>

namespace datmo::submap_matcher_test {
namespace {

/// 8 m straight through the yard; the frame is the vehicle's pose after 4 m.
Submap submapFrom(const Pose2& begin) {
  Submap submap;
  for (int i = 0; i <= 8; ++i) {
    submap.add(Yard().scan(begin * Pose2(i, 0.0, 0.0), i), Pose2(i - 4.0, 0.0, 0.0));
  }
  return submap;
}

PoseWithCovariance within(double meters, double heading) {
  return {Pose2(),
          Eigen::Vector3d(meters * meters, meters * meters, heading * heading).asDiagonal()};
}

TEST(SubmapMatcherTest, FindsWhereASubmapLiesFarBelowTheSizeOfACell) {
  const SubmapMatcher matcher{SubmapMatcherOptions()};
  const Pose2 offset(2.13, -1.07, degrees(4.0));
  const auto result = matcher.match(
      submapFrom(Pose2(4.0, 0.0, 0.0)),
      submapFrom(Pose2(8.0, 0.0, 0.0) * offset * Pose2(-4.0, 0.0, 0.0)), within(2.0, degrees(3.0)));
  ASSERT_EQ(result.outcome, SubmapMatcher::Outcome::kFound);
  const Pose2 error = offset.inverse() * result.newer_in_older.pose;
  EXPECT_LT(error.position().norm(), 0.05);
  EXPECT_LT(std::abs(error.heading()), degrees(0.3));
  EXPECT_GE(result.newer_in_older.covariance(0, 0), 0.05 * 0.05) << "no surer than the floor";
}

TEST(SubmapMatcherTest, OutsideOfThePriorNothingIsFound) {
  const SubmapMatcher matcher{SubmapMatcherOptions()};
  const auto result = matcher.match(submapFrom(Pose2(4.0, 0.0, 0.0)),
                                    submapFrom(Pose2(16.0, 2.0, 0.5)), within(0.3, degrees(1.0)));
  EXPECT_NE(result.outcome, SubmapMatcher::Outcome::kFound);
}

TEST(SubmapMatcherTest, WithoutScansThereIsNothingToCompare) {
  const SubmapMatcher matcher{SubmapMatcherOptions()};
  const auto result = matcher.match(Submap(), submapFrom(Pose2()), within(1.0, 0.1));
  EXPECT_NE(result.outcome, SubmapMatcher::Outcome::kFound);
}

}  // namespace
}  // namespace datmo::submap_matcher_test
