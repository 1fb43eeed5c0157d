// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/map_recovery.h"

#include "walls.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/slam/grid_slam.h"

namespace datmo::map_recovery_test {
namespace {

/// A drive with a gap in scans and odometry, during which the vehicle moves at `speed_in_gap`.
struct Drive {
  double gap = 2.0;           ///< s
  double speed_in_gap = 2.0;  ///< m/s; before and after it 2 m/s
  double turn_in_gap = 0.0;   ///< rad/s
  double late = 0.0;          ///< s, odometry after the first scan
  bool elsewhere = false;     ///< put down in another place
  bool with_odometry = true;
  bool between_walls = false;  ///< instead of in the yard
};

struct Step {
  SlamResult result;
  Pose2 truth;
};

std::vector<Step> run(const Drive& drive, int scans_after = 50) {
  GridSlamOptions options;
  options.recovery.search.max_aligned_sigma = 2.1;  // for a gap of more than a second
  GridSlam slam{options};
  const Yard yard;
  std::vector<Step> steps;
  Pose2 truth;
  double seconds = 0.0;
  const Twist2 twist{2.0, 0.0};
  const auto step = [&](bool with_odometry) {
    const Stamp stamp = Stamp::fromSeconds(1000.0 + seconds);
    if (with_odometry && drive.with_odometry) {
      slam.addOdometry({stamp, twist});
    }
    const Scan scan =
        drive.between_walls ? betweenWalls(truth, seconds, false) : yard.scan(truth, seconds);
    steps.push_back({slam.process(scan), truth});
  };
  for (int i = 0; i < 30; ++i) {
    step(true);
    truth = truth * arc(twist, 0.1);
    seconds += 0.1;
  }
  truth = truth * arc({drive.speed_in_gap, drive.turn_in_gap}, drive.gap);
  truth = drive.elsewhere ? truth * Pose2(0.0, 0.0, 2.5) : truth;
  seconds += drive.gap;
  for (int i = 0; i < scans_after; ++i) {
    step(0.1 * i >= drive.late);
    truth = truth * arc(twist, 0.1);
    seconds += 0.1;
  }
  return steps;
}

Eigen::Vector3d errorOf(const Step& step) {
  const Pose2& pose = step.result.labeled_scan.base_in_map.pose;
  return {pose.x() - step.truth.x(), pose.y() - step.truth.y(),
          angleBetween(step.truth.heading(), pose.heading())};
}

/// Returns whether an error beyond 0.5 m, 2 degrees is at most three standard deviations.
bool admits(const Step& step) {
  const Eigen::Vector3d error = errorOf(step);
  const Eigen::Matrix3d& covariance = step.result.labeled_scan.base_in_map.covariance;
  const double distance = error.head<2>().norm();
  const Eigen::Vector2d along = error.head<2>() / std::max(distance, 1e-9);
  const double sigma = std::sqrt(along.dot(covariance.topLeftCorner<2, 2>() * along));
  const bool position = distance < 0.5 || distance <= 3.0 * sigma;
  const bool heading =
      std::abs(error[2]) < degrees(2.0) || std::abs(error[2]) <= 3.0 * std::sqrt(covariance(2, 2));
  return position && heading;
}

TEST(MapRecoveryTest, AfterAGapItIsUncertainAndNeverConfidentAndWrong) {
  // The pillars of the yard repeat every 9 m: if the vehicle continued at another speed it may not
  // be found, but then it reports that.
  for (const double speed : {0.0, 2.0, 4.0}) {
    for (const double turn : {-0.2, 0.0, 0.2}) {
      const std::vector<Step> steps = run({2.0, speed, turn}, 70);
      EXPECT_EQ(steps[29].result.localization, Localization::kLocated);
      EXPECT_EQ(steps[30].result.localization, Localization::kUncertain) << speed << ", " << turn;
      EXPECT_EQ(steps.back().result.localization, Localization::kLocated) << speed << ", " << turn;
      for (const Step& step : steps) {
        EXPECT_TRUE(admits(step)) << speed << ", " << turn;
      }
    }
  }
}

TEST(MapRecoveryTest, ItIsFoundWhereNothingElseFits) {
  const std::vector<Step> steps = run({1.2, 2.5, 0.1}, 50);
  EXPECT_EQ(steps.back().result.maps_begun, 0);
  EXPECT_EQ(steps.back().result.localization, Localization::kLocated);
  EXPECT_LT(errorOf(steps.back()).head<2>().norm(), 0.3);
  EXPECT_LT(steps.back().result.labeled_scan.base_in_map.covariance(0, 0), 0.1);
}

TEST(MapRecoveryTest, LateOdometryStillBoundsTheGap) {
  const Eigen::Matrix3d in_time =
      run({2.0, 2.0}, 4).back().result.labeled_scan.base_in_map.covariance;
  const Eigen::Matrix3d late =
      run({2.0, 2.0, 0.0, 0.15}, 4).back().result.labeled_scan.base_in_map.covariance;
  EXPECT_LT(late(0, 0), 1.5 * in_time(0, 0));
}

TEST(MapRecoveryTest, WithoutOdometryItIsFoundToo) {
  Drive drive{1.5, 2.0};
  drive.with_odometry = false;
  const std::vector<Step> steps = run(drive);
  EXPECT_EQ(steps[30].result.localization, Localization::kUncertain);
  for (const Step& step : steps) {
    EXPECT_TRUE(admits(step));
  }
  EXPECT_EQ(steps.back().result.localization, Localization::kLocated);
  EXPECT_EQ(steps.back().result.maps_begun, 0) << "found, and not given up";
  EXPECT_LT(errorOf(steps.back()).head<2>().norm(), 0.3);
}

TEST(MapRecoveryTest, OdometryAgainstPosesOfTheNewerMapDoesNotLeadIntoTheOlder) {
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  const Twist2 twist{2.0, 0.0};
  Pose2 truth;
  double seconds = 0.0;
  const auto step = [&](const std::optional<Pose2>& base_in_odom) {
    const Stamp stamp = Stamp::fromSeconds(1000.0 + seconds);
    if (base_in_odom) {
      slam.addOdometry({stamp, twist, base_in_odom});
    }
    const Step result{slam.process(yard.scan(truth, seconds)), truth};
    truth = truth * arc(twist, 0.1);
    seconds += 0.1;
    return result;
  };
  for (int i = 0; i < 30; ++i) {
    step(truth);
  }
  truth = truth * arc({4.0, 0.0}, 2.0);
  seconds += 2.0;
  const Pose2 reset(1000.0, 0.0, 0.0);  // the encoders have been reset
  EXPECT_EQ(step(reset * truth).result.localization, Localization::kUncertain);
  for (int i = 0; i < 2; ++i) {
    step(reset * truth);
  }
  for (int i = 0; i < 3; ++i) {
    step(std::nullopt);
  }
  const Step last = step(reset * truth * Pose2(3.0, 0.0, 0.0));
  EXPECT_EQ(last.result.localization, Localization::kUncertain);
  EXPECT_TRUE(admits(last));
}

TEST(MapRecoveryTest, BetweenWallsTheMapsAreAlignedAndTheDistanceRemainsUncertain) {
  Drive drive{1.2, 2.5, 0.2};
  drive.between_walls = true;
  const std::vector<Step> steps = run(drive, 60);
  const Step& last = steps.back();
  EXPECT_EQ(last.result.localization, Localization::kLocated);
  EXPECT_EQ(last.result.maps_begun, 0) << "the map goes on";
  const Eigen::Matrix3d covariance = last.result.labeled_scan.base_in_map.covariance;
  EXPECT_NEAR(errorOf(last).y(), 0.0, 0.3);
  EXPECT_NEAR(errorOf(last)[2], 0.0, degrees(1.5));
  EXPECT_LT(covariance(1, 1), square(1.0));
  EXPECT_GT(covariance(0, 0), square(0.4)) << "no wall tells how far it went";
  for (const Step& step : steps) {
    EXPECT_TRUE(admits(step));
  }
}

TEST(MapRecoveryTest, WhileItIsNotLocatedNothingMoves) {
  for (const Step& step : run({2.0, 4.0})) {
    if (step.result.localization == Localization::kLocated) {
      continue;
    }
    for (const ScanPoint& point : step.result.labeled_scan.points) {
      EXPECT_NE(point.state, PointState::kMoving);
    }
  }
}

TEST(MapRecoveryTest, PutDownElsewhereItContinuesInANewMap) {
  const std::vector<Step> steps = run({2.0, 2.0, 0.0, 0.0, true}, 70);
  EXPECT_EQ(steps.back().result.localization, Localization::kLocated);
  EXPECT_EQ(steps.back().result.maps_begun, 1);
  EXPECT_GT(steps.back().result.labeled_scan.base_in_map.covariance(2, 2), 0.04)
      << "what the gap left open";
  EXPECT_TRUE(steps.back().result.match.accepted);
}

TEST(MapRecoveryTest, ShortGapsAreMatchedAsUsual) {
  for (const Step& step : run({0.5, 2.5})) {
    EXPECT_EQ(step.result.localization, Localization::kLocated);
    EXPECT_LT(errorOf(step).head<2>().norm(), 0.3);
  }
}

}  // namespace
}  // namespace datmo::map_recovery_test
