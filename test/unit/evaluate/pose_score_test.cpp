// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/pose_score.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "evaluate/made_recordings.h"
#include <gtest/gtest.h>

namespace datmo::evaluation::pose_score_test {
namespace {

constexpr double kMaxGap = 0.5;  // s

/// 100 m along x at 10 m/s, a pose every 0.1 s, as estimated by `pose_at` (argument: m driven).
Trajectory driveOf(const std::function<Pose2(double)>& pose_at) {
  std::vector<StampedPose> poses;
  for (int i = 0; i <= 100; ++i) {
    poses.push_back(poseAt(0.1 * i, pose_at(1.0 * i)));
  }
  return {poses, kMaxGap};
}

Trajectory truth() {
  return driveOf([](double path_length) { return Pose2(path_length, 0.0, 0.0); });
}

PoseScore scoreOf(const std::function<Pose2(double)>& pose_at) {
  const auto score = scorePoses(driveOf(pose_at), truth());
  EXPECT_TRUE(score);
  return score.value_or(PoseScore());
}

TEST(ScorePoses, TheSamePosesInAnotherMapHaveNoError) {
  const Pose2 elsewhere(7.0, -3.0, 2.0);
  const PoseScore score =
      scoreOf([&](double path_length) { return elsewhere * Pose2(path_length, 0.0, 0.0); });
  EXPECT_NEAR(score.end_error, 0.0, 1e-9);
  EXPECT_NEAR(score.end_heading_error, 0.0, 1e-9);
  EXPECT_NEAR(score.path_length, 100.0, 1e-9);
  EXPECT_NEAR(score.position_rmse, 0.0, 1e-9);
  EXPECT_NEAR(score.largest_jump, 0.0, 1e-9);
  ASSERT_EQ(score.relative.size(), 2U);
  EXPECT_NEAR(score.relative[1].translation.value(), 0.0, 1e-9);
}

TEST(ScorePoses, AScaleErrorGrowsWithTheDistance) {
  const PoseScore score =
      scoreOf([](double path_length) { return Pose2(1.02 * path_length, 0.0, 0.0); });
  EXPECT_NEAR(score.end_error, 2.0, 1e-9);
  EXPECT_NEAR(score.end_share.value(), 0.02, 1e-9);
  // Mean of (0.02 i)^2 over i = 0 ... 100: 0.0004 * 338350 / 101.
  EXPECT_NEAR(score.position_rmse, std::sqrt(0.0004 * 338350.0 / 101.0), 1e-9);
  EXPECT_NEAR(score.heading_rmse, 0.0, 1e-9);
  EXPECT_NEAR(score.largest_jump, 0.2, 1e-9);  // in one second, 10 m
  EXPECT_NEAR(score.relative[0].distance, 10.0, 1e-9);
  EXPECT_NEAR(score.relative[0].translation.value(), 0.2, 1e-9);
  EXPECT_EQ(score.relative[0].pairs, 91U);
  EXPECT_NEAR(score.relative[1].distance, 70.0, 1e-9);
  EXPECT_NEAR(score.relative[1].translation.value(), 1.4, 1e-9);
  EXPECT_EQ(score.relative[1].pairs, 31U);
}

TEST(ScorePoses, AWrongTurnIsInTheHeadingOfTheRelations) {
  const PoseScore score =
      scoreOf([](double path_length) { return Pose2(path_length, 0.0, 0.001 * path_length); });
  EXPECT_NEAR(score.end_heading_error, 0.1, 1e-9);
  EXPECT_NEAR(score.relative[0].rotation.value(), 0.01, 1e-9);
  EXPECT_NEAR(score.heading_rmse, 0.001 * std::sqrt(338350.0 / 101.0), 1e-9);
}

TEST(ScorePoses, AJumpIsFoundWhateverTheDriftBefore) {
  const PoseScore score = scoreOf([](double path_length) {
    return Pose2(path_length, path_length < 50.0 ? 0.001 * path_length : 1.5, 0.0);
  });
  EXPECT_NEAR(score.largest_jump, 1.5 - 0.04, 1e-9);  // from 40 m, one second before
}

TEST(ScorePoses, ErrorsAreIndependentOfTheHeading) {
  // Always 1 m too far to the vehicle's left from 2 s on, while it turns around.
  const auto turning = [](double path_length) {
    return Pose2(path_length, 0.0, 0.05 * path_length);
  };
  const auto estimated = driveOf([&](double path_length) {
    return turning(path_length) * (path_length < 20.0 ? Pose2() : Pose2(0.0, 1.0, 0.0));
  });
  const auto score = scorePoses(estimated, driveOf(turning));
  ASSERT_TRUE(score);
  EXPECT_NEAR(score->largest_jump, 1.0, 1e-9);
}

TEST(ScorePoses, AnOldDriftIsNoJumpWhenTheVehicleTurns) {
  // 50 m with a scale error, and then a turn on the spot.
  const auto driven = [](double scale) {
    return driveOf([scale](double path_length) {
      return Pose2(scale * std::min(path_length, 50.0), 0.0,
                   0.05 * std::max(0.0, path_length - 50.0));
    });
  };
  const auto score = scorePoses(driven(1.02), driven(1.0));
  ASSERT_TRUE(score);
  EXPECT_NEAR(score->end_error, 1.0, 1e-9);
  EXPECT_NEAR(score->largest_jump, 0.2, 1e-9);
}

TEST(ScorePoses, AStationaryVehicleHasNoShareAndNoRelations) {
  const auto standing = driveOf([](double) { return Pose2(); });
  const auto score = scorePoses(standing, standing);
  ASSERT_TRUE(score);
  EXPECT_EQ(score->path_length, 0.0);
  EXPECT_FALSE(score->end_share);
  EXPECT_FALSE(score->relative[0].translation);
  EXPECT_FALSE(score->relative[0].rotation);
  EXPECT_EQ(score->relative[0].pairs, 0U);
}

TEST(ScorePoses, NeesIsTheErrorInUnitsOfTheCovariance) {
  // The run's map is rotated by 90 degrees, so that it drives along y there. An error of 2 m ahead
  // with a variance of 4 m^2 along that axis is a NEES of 1.
  std::vector<StampedPose> poses;
  for (int i = 0; i <= 10; ++i) {
    StampedPose pose = poseAt(0.1 * i, Pose2(0.0, 1.0 * i + (i == 0 ? 0.0 : 2.0), kPi / 2));
    pose.pose.covariance.diagonal() << 100.0, 4.0, 0.01;
    poses.push_back(pose);
  }
  const auto score = scorePoses({poses, kMaxGap}, truth());
  ASSERT_TRUE(score);
  EXPECT_EQ(score->consistency.samples, 11U);
  EXPECT_EQ(score->consistency.degrees_of_freedom, 3);
  EXPECT_NEAR(score->consistency.mean_nees.value(), 10.0 / 11.0, 1e-9);
}

TEST(ScorePoses, WithoutCovarianceThereIsNoNees) {
  const auto score = scorePoses(truth(), truth());
  EXPECT_FALSE(score->consistency.mean_nees);
  EXPECT_EQ(score->consistency.samples, 0U);
  EXPECT_EQ(score->consistency.unusable, truth().poses().size() - 1) << "all but the alignment";
}

TEST(ScorePoses, TheOriginOfTheMapHasNoErrorAndNoCovariance) {
  std::vector<StampedPose> poses = truth().poses();
  for (auto pose = poses.begin() + 1; pose != poses.end(); ++pose) {
    pose->pose.covariance.setIdentity();
  }
  const auto score = scorePoses({poses, kMaxGap}, truth());
  ASSERT_TRUE(score);
  EXPECT_EQ(score->consistency.samples, poses.size() - 1);
  EXPECT_EQ(score->consistency.unusable, 0U);
}

TEST(ScorePoses, WithoutOverlapThereIsNoScore) {
  EXPECT_FALSE(scorePoses({{poseAt(90.0, Pose2())}, kMaxGap}, truth()));
  EXPECT_FALSE(scorePoses({{}, kMaxGap}, truth()));
}

}  // namespace
}  // namespace datmo::evaluation::pose_score_test
