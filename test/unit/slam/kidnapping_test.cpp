// SPDX-License-Identifier: BSD-3-Clause
// A vehicle that is carried elsewhere between two scans without odometry noticing.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "yard.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/slam/grid_slam.h"

namespace datmo::kidnapping_test {
namespace {

constexpr double kInterval = 0.1;   // s
constexpr Twist2 kTwist{2.0, 0.5};  // in a circle of 25 m

struct Step {
  SlamResult result;
  Pose2 truth;
};

/// A drive of 4 s, carried by `carried` in the vehicle's frame, and another drive.
std::vector<Step> drive(const std::optional<Pose2>& carried, int scans_after,
                        const GridSlamOptions& options = {}, int scans_before = 40) {
  GridSlam slam{options};
  const Yard yard;
  std::vector<Step> steps;
  Pose2 truth;
  for (int i = 0; i < scans_before + scans_after; ++i) {
    if (i == scans_before && carried) {
      truth = truth * *carried;
    }
    const double seconds = kInterval * i;
    slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds), kTwist});
    steps.push_back({slam.process(yard.scan(truth, seconds)), truth});
    truth = truth * arc(kTwist, kInterval);
  }
  return steps;
}

double errorOf(const Step& step) {
  const Pose2& pose = step.result.labeled_scan.base_in_map.pose;
  return (pose.position() - step.truth.position()).norm();
}

double sigmaOf(const Step& step) {
  return std::sqrt(step.result.labeled_scan.base_in_map.covariance.topLeftCorner<2, 2>().trace());
}

/// In view of what was seen before.
const std::vector<Pose2> kKnown{{8.0, 5.0, -1.5}, {10.0, -3.0, 1.0}};
/// Facing an area that no scan has seen.
const Pose2 kUnknown(14.0, -6.0, kPi);

TEST(KidnappingTest, NoPoseIsConfidentAndWrong) {
  for (const Pose2& carried : {kKnown[0], kKnown[1], kUnknown}) {
    const std::vector<Step> steps = drive(carried, 60);
    EXPECT_EQ(steps[39].result.localization, Localization::kLocated);
    EXPECT_TRUE(steps[50].result.kidnapped) << carried.x();
    for (const Step& step : steps) {
      EXPECT_LT(errorOf(step), std::max(0.5, 3.0 * sigmaOf(step))) << carried.x();
    }
  }
}

TEST(KidnappingTest, ItIsFoundInTheMapItWasIn) {
  for (const Pose2& carried : kKnown) {
    const std::vector<Step> steps = drive(carried, 80, {}, 130);
    EXPECT_EQ(steps.back().result.localization, Localization::kLocated);
    EXPECT_FALSE(steps.back().result.kidnapped);
    EXPECT_EQ(steps.back().result.maps_begun, 0);
    EXPECT_LT(errorOf(steps.back()), 0.3) << carried.x();
    EXPECT_LT(sigmaOf(steps.back()), 0.3) << carried.x();
  }
}

TEST(KidnappingTest, InUnmappedSpaceItContinuesInANewMap) {
  const Step last = drive(kUnknown, 80).back();
  EXPECT_EQ(last.result.localization, Localization::kLocated);
  EXPECT_EQ(last.result.maps_begun, 1);
  EXPECT_GT(sigmaOf(last), 100.0);
}

TEST(KidnappingTest, AGapMeanwhileEndsNoSearch) {
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  Pose2 truth;
  double seconds = 0.0;
  SlamResult result;
  for (int i = 0; i < 60; ++i) {
    truth = i == 40 ? truth * kKnown.front() : truth;
    seconds += i == 55 ? 3.0 : kInterval;  // it keeps moving meanwhile
    truth = truth * arc(kTwist, i == 55 ? 3.0 : kInterval);
    slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds), kTwist});
    result = slam.process(yard.scan(truth, seconds));
  }
  EXPECT_TRUE(result.kidnapped);
}

TEST(KidnappingTest, NothingDriftsWhileItIsSuspected) {
  const std::vector<Step> steps = drive(kUnknown, 60);
  std::size_t suspected = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    if (steps[i].result.may_be_kidnapped && steps[i - 1].result.may_be_kidnapped) {
      ++suspected;
      EXPECT_LE(steps[i].result.drift(2, 2), steps[i - 1].result.drift(2, 2) + 1e-12);
    }
  }
  EXPECT_GT(suspected, 3U);
}

TEST(KidnappingTest, NothingMovesMeanwhile) {
  const std::vector<Step> steps = drive(kKnown.front(), 10);
  for (std::size_t i = 40; i < steps.size(); ++i) {
    for (const ScanPoint& point : steps[i].result.labeled_scan.points) {
      EXPECT_NE(point.state, PointState::kMoving);
    }
  }
}

TEST(KidnappingTest, WithoutKidnappingItStaysLocated) {
  for (const Step& step : drive(std::nullopt, 60)) {
    EXPECT_EQ(step.result.localization, Localization::kLocated);
    EXPECT_LT(sigmaOf(step), 0.3);
  }
}

TEST(KidnappingTest, WithoutTheTestThePoseIsConfidentAndWrong) {
  GridSlamOptions options;
  options.recovery.min_kidnapped_log_ratio = 1000.0;
  const Step last = drive(kKnown.front(), 20, options).back();
  EXPECT_EQ(last.result.localization, Localization::kLocated);
  EXPECT_GT(errorOf(last), 3.0 * sigmaOf(last));
}

TEST(KidnappingTest, WhereTheVehiclePitchesOnlyThePoseIsUncertain) {
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  Pose2 truth;
  for (int i = 0; i < 60; ++i) {
    const double seconds = kInterval * i;
    Scan scan = yard.scan(truth, seconds);
    const bool pitches = i >= 40 && i < 46;
    for (Ray& ray : scan.rays) {  // the beams hit the road
      ray.range = pitches ? std::min(ray.range, 4.0) : ray.range;
      ray.end =
          scan.scanner_in_base * (ray.range * Point2(std::cos(ray.bearing), std::sin(ray.bearing)));
    }
    slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds), kTwist});
    const Step step{slam.process(scan), truth};
    EXPECT_EQ(step.result.localization, Localization::kLocated);
    EXPECT_EQ(step.result.may_be_kidnapped, pitches) << i;
    EXPECT_EQ(sigmaOf(step) > 100.0, pitches) << i;
    EXPECT_LT(errorOf(step), 0.3) << i;
    truth = truth * arc(kTwist, kInterval);
  }
}

TEST(KidnappingTest, ATruckThatCoversHalfOfTheViewIsTraffic) {
  GridSlam slam{GridSlamOptions{}};
  const Yard yard;
  for (int i = 0; i < 60; ++i) {
    const double seconds = kInterval * i;
    // Across in front of the stationary vehicle, from the right at 6 m/s.
    const Box2 truck{Pose2(8.0, -30.0 + 6.0 * seconds, 0.5 * kPi), 12.0, 2.5};
    slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds), Twist2{}});
    const SlamResult result = slam.process(yard.scan(Pose2(), seconds, &truck));
    EXPECT_EQ(result.localization, Localization::kLocated) << seconds;
  }
}

}  // namespace
}  // namespace datmo::kidnapping_test
