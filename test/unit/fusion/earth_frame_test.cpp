// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "earth_drive.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/earth/earth_frame_filter.h"
#include "datmo_fusion/fusion/earth/local_plane.h"

namespace datmo {
namespace {

constexpr double kDegree = kPi / 180.0;

/// Processes 30 s of fixes, so that the map is known; returns the last one.
EarthFix drivenBefore(Drive& drive, EarthFrameFilter& filter) {
  EarthFix last;
  for (int i = 0; i < 150; ++i) {
    last = drive.next();
    filter.add(last);
  }
  return last;
}

TEST(LocalPlane, KnownDistancesOnTheEllipsoid) {
  // One minute of arc: on the equator eastward a * pi / 10800; northward the meridian's curvature.
  const LocalPlane equator({0.0, 10.0 * kDegree, 0.0});
  const Point2 east = equator.toPlane({0.0, (10.0 + 1.0 / 60.0) * kDegree, 0.0});
  EXPECT_NEAR(east.x(), 1855.325, 0.01);
  EXPECT_NEAR(east.y(), 0.0, 1e-6);
  const Point2 north = equator.toPlane({1.0 / 60.0 * kDegree, 10.0 * kDegree, 0.0});
  EXPECT_NEAR(north.y(), 1842.905, 0.01);
  EXPECT_NEAR(north.x(), 0.0, 1e-6);
}

TEST(LocalPlane, RoundTrip) {
  const LocalPlane plane({45.19 * kDegree, 5.72 * kDegree, 212.0});
  for (const Point2& point : {Point2(0.0, 0.0), Point2(300.0, -40.0), Point2(-2000.0, 3000.0)}) {
    GeodeticPosition back = plane.toGeodetic(point);
    EXPECT_LT((plane.toPlane(back) - point).norm(), 2e-3 + 1e-6 * point.squaredNorm());
  }
}

TEST(LocalPlane, PositionsOffTheEarth) {
  EXPECT_TRUE(isValid({0.8, 0.1, 200.0}));
  EXPECT_FALSE(isValid({1.6, 0.1, 200.0}));
  EXPECT_FALSE(isValid({std::nan(""), 0.1, 200.0}));
  EXPECT_FALSE(isValid({0.8, 0.1, 1e7}));
}

TEST(EarthFrameFilter, IsUnknownAtRest) {
  EarthFrameFilter filter{EarthFrameOptions()};
  EarthFix fix;
  for (int i = 0; i < 1000; ++i) {
    fix.stamp = Stamp::fromSeconds(10.0 + 0.2 * i);
    filter.add(fix);
    ASSERT_FALSE(filter.mapInPlane());
  }
}

TEST(EarthFrameFilter, FindsTheMapWithinItsCovariance) {
  EarthFrameOptions options;
  options.map_drift = options.map_turn = 0.0;  // this map does not drift
  double nees = 0.0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    Drive drive(static_cast<unsigned>(run + 1), 1.5, options);
    EarthFrameFilter filter(options);
    for (int i = 0; i < 300; ++i) {
      filter.add(drive.next());
    }
    const auto map = filter.mapInPlane();
    ASSERT_TRUE(map);
    const Eigen::Vector3d error = errorOf(map->pose, drive.truth());
    nees += error.dot(map->covariance.inverse() * error) / kRuns;
    EXPECT_LT(std::abs(error.z()), 0.1);
  }
  // Mean of 200 draws of chi-square with 3 degrees of freedom: 2.54 to 3.49 in 99.5 %; the first
  // solution is not optimal, and may be conservative.
  EXPECT_GT(nees, 1.5);
  EXPECT_LT(nees, 3.6);
}

TEST(EarthFrameFilter, FixFarOffIsLeftOut) {
  Drive drive(1, 0.5, EarthFrameOptions());
  EarthFrameFilter filter{EarthFrameOptions()};
  for (int i = 0; i < 200; ++i) {
    EarthFix fix = drive.next();
    if (i % 50 == 49) {
      fix.in_plane.x() += 30.0;
    }
    filter.add(fix);
  }
  EXPECT_GE(filter.counts().gated, 3U);
  EXPECT_EQ(filter.counts().restarts, 0U);
  EXPECT_LT(
      (filter.mapInPlane()->pose * Point2(400.0, 200.0) - drive.truth() * Point2(400.0, 200.0))
          .norm(),
      3.0);
}

TEST(EarthFrameFilter, LossOfAllDigitsStartsItOver) {
  for (const double far : {1e9, 1e150, 1e300}) {
    Drive drive(3, 0.5, EarthFrameOptions());
    EarthFrameFilter filter{EarthFrameOptions()};
    for (int i = 0; i < 600; ++i) {
      EarthFix fix = drive.next();
      if (i == 200) {
        fix.base_in_map = {Pose2(far, -far, 0.0), far * Eigen::Matrix3d::Identity()};
      }
      filter.add(fix);
      const auto map = filter.mapInPlane();
      ASSERT_TRUE(!map || (map->pose.position().allFinite() && map->covariance.allFinite())) << far;
    }
    EXPECT_TRUE(filter.mapInPlane()) << "it comes back after " << far;
  }
}

// 4 s without a fix, 40 m of drift: the reported uncertainty of the map grows by it.
TEST(EarthFrameFilter, AccountsForTheMapsDriftInAnOutage) {
  const EarthFrameOptions options;
  double nees = 0.0;
  double nees_of_last = 0.0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    Drive drive(static_cast<unsigned>(run + 1), 0.1, options, true);
    EarthFrameFilter filter(options);
    drivenBefore(drive, filter);
    const auto map_of_last = filter.mapInPlane();
    ASSERT_TRUE(map_of_last);
    for (int i = 0; i < 20; ++i) {
      filter.moveTo(drive.next().base_in_map.pose);
    }
    const auto map = filter.mapInPlane();
    ASSERT_TRUE(map);
    const Eigen::Vector3d error = errorOf(map->pose, drive.truth());
    nees += error.dot(map->covariance.inverse() * error) / kRuns;
    nees_of_last += error.dot(map_of_last->covariance.inverse() * error) / kRuns;
  }
  EXPECT_GT(nees, 2.0);
  EXPECT_LT(nees, 3.6);
  EXPECT_GT(nees_of_last, 6.0) << "else the outage is too short to tell";
}

// The traveled distance counts, not the distance from the last fix.
TEST(EarthFrameFilter, ALoopWithoutFixesCountsAsDistance) {
  const EarthFrameOptions options;
  Drive drive(1, 0.1, options);
  EarthFrameFilter filter(options);
  EarthFix last = drivenBefore(drive, filter);
  const auto before = filter.mapInPlane();
  ASSERT_TRUE(before);
  constexpr int kPoses = 100;
  constexpr double kRadius = 20.0;  // m
  for (int i = 1; i <= kPoses; ++i) {
    const double angle = 2.0 * kPi * i / kPoses;
    filter.moveTo(last.base_in_map.pose *
                  Pose2(kRadius * std::sin(angle), kRadius * (1.0 - std::cos(angle)), angle));
    const auto map = filter.mapInPlane();
    ASSERT_TRUE(map);
    const Eigen::Matrix3d grown = map->covariance - before->covariance;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(grown).eigenvalues()(0), -1e-9) << i;
  }
  const double distance = 2.0 * kPi * kRadius;
  const double turned = filter.mapInPlane()->covariance(2, 2) - before->covariance(2, 2);
  EXPECT_NEAR(turned, distance * options.map_turn * options.map_turn, 0.01 * turned);
  // The next fix is at the position of the last one, and finds the map equally uncertain.
  EarthFrameFilter by_straight_line(options);
  Drive again(1, 0.1, options);
  drivenBefore(again, by_straight_line);
  last.stamp = last.stamp + 1.0;
  filter.add(last);
  by_straight_line.add(last);
  EXPECT_GT(filter.mapInPlane()->covariance(2, 2), by_straight_line.mapInPlane()->covariance(2, 2));
}

TEST(EarthFrameFilter, AJitteringPoseIsNoDistance) {
  const EarthFrameOptions options;
  Drive drive(1, 0.1, options);
  EarthFrameFilter filter(options);
  EarthFix last = drivenBefore(drive, filter);
  const auto before = filter.mapInPlane();
  ASSERT_TRUE(before);
  for (int i = 0; i < 10000; ++i) {
    filter.moveTo(last.base_in_map.pose * Pose2(i % 2 == 0 ? 0.02 : 0.0, 0.0, 0.0));
  }
  EXPECT_EQ(filter.mapInPlane()->covariance, before->covariance);
}

TEST(EarthFrameFilter, StartsOverWhenTheMapIsAnother) {
  const EarthFrameOptions options;
  Drive drive(2, 0.5, options);
  EarthFrameFilter filter(options);
  for (int i = 0; i < 400; ++i) {
    EarthFix fix = drive.next();
    if (i >= 200) {
      fix.in_plane += Point2(200.0, 0.0);
    }
    filter.add(fix);
  }
  EXPECT_EQ(filter.counts().restarts, 1U);
  ASSERT_TRUE(filter.mapInPlane());
  EXPECT_LT((filter.mapInPlane()->pose * Point2(450.0, 300.0) -
             (drive.truth() * Point2(450.0, 300.0) + Point2(200.0, 0.0)))
                .norm(),
            3.0);
}

}  // namespace
}  // namespace datmo
