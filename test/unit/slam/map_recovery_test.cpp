// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/map_recovery.h"

#include <memory>
#include <vector>

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

/// A search that finds where a newer map of the yard begins in an older one.
class SearchRateTest : public testing::Test {
 protected:
  static PoseWithCovariance guessAt(const Pose2& pose) {
    return {pose, Eigen::Vector3d(4.0, 2.25, 0.09).asDiagonal()};
  }

  static OccupancyMap mapOf(const Pose2& from, const Pose2& in_map) {
    OccupancyMap map{OccupancyMapOptions{}};
    for (int i = 0; i <= 20; ++i) {
      const Pose2 motion = arc({2.0, 0.0}, 0.1 * i);
      map.centerOn((in_map * motion).position());
      const Scan scan = Yard().scan(from * motion, 0.1 * i);
      map.update(scan, std::vector<PointState>(scan.rays.size(), PointState::kUnknown),
                 in_map * motion);
    }
    return map;
  }

  /// Returns how many boxes the search examines, up to a few.
  int boxes() const {
    constexpr int kAtOnce = 50;
    MapSearch search(options_.search, std::make_shared<const SearchedMap>(older_), newer_, {guess_},
                     guess_.pose);
    int count = kAtOnce;
    while (search.advance(kAtOnce) == MapSearch::Outcome::kUnfinished) {
      count += kAtOnce;
    }
    return count;
  }

  /// Returns the time (s) from the first scan of the search until the pose is found; negative if it
  /// is not. `period`: s, of the scans.
  double timeUntilFound(int boxes_per_second, double period) const {
    MapRecoveryOptions options = options_;
    options.boxes_per_second = boxes_per_second;
    options.first_search_after = 0.0;
    MapRecovery recovery(options, older_, guess_, Stamp::fromSeconds(1000.0));
    for (int i = 1; period * i < kMaxTime; ++i) {
      const PoseWithCovariance in_newer{guess_.pose, Eigen::Matrix3d::Zero()};
      if (recovery.advance(newer_, in_newer, Stamp::fromSeconds(1000.0 + period * i))) {
        return period * i;
      }
    }
    return -1.0;
  }

  static constexpr double kMaxTime = 10.0;  // s

  MapRecoveryOptions options_;
  Pose2 ahead_{8.0, 1.0, 0.1};
  PoseWithCovariance guess_ = guessAt(ahead_ * Pose2(1.5, 1.0, 0.0));
  OccupancyMap older_ = mapOf(Pose2(), Pose2());
  OccupancyMap newer_ = mapOf(ahead_, guess_.pose);
};

TEST_F(SearchRateTest, ASearchTakesAsLongWhateverTheRateOfTheScans) {
  const int in_two_seconds = boxes() / 2;
  for (const double period : {0.2, 0.1, 0.05}) {
    EXPECT_NEAR(timeUntilFound(in_two_seconds, period), 2.0, 0.5) << period;
  }
  EXPECT_NEAR(timeUntilFound(2 * in_two_seconds, 0.1), 1.0, 0.3);
  EXPECT_LT(timeUntilFound(1, 0.1), 0.0);
}

}  // namespace
}  // namespace datmo::map_recovery_test
