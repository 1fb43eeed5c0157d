// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/earth/consistent_pairs.h"
#include "datmo_fusion/fusion/earth/earth_frame_filter.h"
#include "datmo_fusion/fusion/earth/local_plane.h"

namespace datmo {
namespace {

constexpr double kDegree = kPi / 180.0;

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

TEST(LocalPlane, ThereAndBack) {
  const LocalPlane plane({45.19 * kDegree, 5.72 * kDegree, 212.0});
  for (const Point2& point : {Point2(0.0, 0.0), Point2(300.0, -40.0), Point2(-2000.0, 3000.0)}) {
    GeodeticPosition back = plane.toGeodetic(point);
    EXPECT_LT((plane.toPlane(back) - point).norm(), 2e-3 + 1e-6 * point.squaredNorm());
  }
}

TEST(LocalPlane, WhatIsNotOnTheEarth) {
  EXPECT_TRUE(isValid({0.8, 0.1, 200.0}));
  EXPECT_FALSE(isValid({1.6, 0.1, 200.0}));
  EXPECT_FALSE(isValid({std::nan(""), 0.1, 200.0}));
  EXPECT_FALSE(isValid({0.8, 0.1, 1e7}));
}

// A drive along a curve, seen by a receiver with white noise and an error that drifts.
class Drive {
 public:
  Drive(unsigned seed, double sigma, const EarthFrameOptions& options, bool drifts = false)
      : random_(seed), sigma_(sigma), options_(options), drifts_(drifts) {
    shared_ = std::sqrt(options.correlated_share) * sigma_ * draw2();
  }

  EarthFix next() {
    const double keep = std::exp(-kPeriod / options_.correlation_time);
    shared_ = keep * shared_ +
              std::sqrt(options_.correlated_share * (1.0 - keep * keep)) * sigma_ * draw2();
    time_ += kPeriod;
    const double angle = 0.02 * time_;
    const Pose2 base(500.0 * std::sin(angle), 500.0 * (1.0 - std::cos(angle)), angle);
    const double distance = drifts_ ? 500.0 * 0.02 * kPeriod : 0.0;
    const double turn = std::sqrt(distance) * options_.map_turn * normal_(random_);
    const Point2 there = truth_ * base.position();  // about which the map turns
    const Pose2 turned(0.0, 0.0, truth_.heading() + turn);
    truth_ = Pose2(
        there - turned.rotate(base.position()) + std::sqrt(distance) * options_.map_drift * draw2(),
        turned.heading());
    EarthFix fix;
    fix.stamp = Stamp::fromSeconds(100.0 + time_);
    fix.base_in_map = {base, 1e-4 * Eigen::Matrix3d::Identity()};
    fix.antenna_in_base = {1.2, 0.3};
    fix.in_plane = truth_ * (fix.base_in_map.pose * fix.antenna_in_base) + shared_ +
                   std::sqrt(1.0 - options_.correlated_share) * sigma_ * draw2();
    fix.covariance = sigma_ * sigma_ * Eigen::Matrix2d::Identity();
    return fix;
  }

  const Pose2& truth() const { return truth_; }

 private:
  static constexpr double kPeriod = 0.2;  // s
  Point2 draw2() {
    const double x = normal_(random_);
    return {x, normal_(random_)};
  }

  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  double sigma_;
  EarthFrameOptions options_;
  bool drifts_;  ///< the map, as the options say
  Pose2 truth_{120.0, -60.0, 2.2};
  Point2 shared_ = Point2::Zero();
  double time_ = 0.0;
};

Eigen::Vector3d errorOf(const Pose2& estimate, const Pose2& truth) {
  Eigen::Vector3d error;
  error << estimate.position() - truth.position(),
      normalizeAngle(estimate.heading() - truth.heading());
  return error;
}

TEST(EarthFrameFilter, KnowsNothingWhileItStands) {
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
  // solution is not optimal, and may be too careful.
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

TEST(EarthFrameFilter, WhatLeavesNoDigitStartsItOver) {
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

// 4 s without a fix, 40 m of drift: what is said of the map then grows by it.
TEST(EarthFrameFilter, KnowsInAnOutageWhatTheMapHasDrifted) {
  const EarthFrameOptions options;
  double nees = 0.0;
  double nees_of_last = 0.0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    Drive drive(static_cast<unsigned>(run + 1), 0.1, options, true);
    EarthFrameFilter filter(options);
    for (int i = 0; i < 150; ++i) {
      filter.add(drive.next());
    }
    Pose2 base;
    for (int i = 0; i < 20; ++i) {
      base = drive.next().base_in_map.pose;
    }
    const auto map = filter.mapInPlane(base);
    ASSERT_TRUE(map);
    const Eigen::Vector3d error = errorOf(map->pose, drive.truth());
    nees += error.dot(map->covariance.inverse() * error) / kRuns;
    nees_of_last += error.dot(filter.mapInPlane()->covariance.inverse() * error) / kRuns;
  }
  EXPECT_GT(nees, 2.0);
  EXPECT_LT(nees, 3.6);
  EXPECT_GT(nees_of_last, 6.0) << "else the outage is too short to tell";
}

// In standard deviations, of three degrees of freedom together: 99.9 % are below 4.03.
double deviationOf(const PoseWithCovariance& map, const Pose2& truth) {
  const Eigen::Vector3d error = errorOf(map.pose, truth);
  return std::sqrt(error.dot(map.covariance.inverse() * error));
}

// One position that is far off in some direction, anywhere at the start, is not in what is said
// then: the error stays what is said of it, from the first frame on.
TEST(EarthFrameFilter, FixFarOffAtTheStartIsLeftOut) {
  EarthFrameOptions options;
  options.map_drift = options.map_turn = 0.0;  // this map does not drift
  int starts = 0;
  int large = 0;
  for (const double size : {1.0, 2.0, 5.0, 10.0, 30.0, 100.0}) {
    for (int outlier = 0; outlier < 10; ++outlier) {
      for (unsigned seed = 1; seed <= 20; ++seed) {
        Drive drive(seed, 0.5, options);
        EarthFrameFilter filter(options);
        for (int i = 0; i < 60; ++i) {
          EarthFix fix = drive.next();
          if (i == outlier) {
            fix.in_plane += size * Pose2(0.0, 0.0, 1.3 * seed).rotate({1.0, 0.0});
          }
          filter.add(fix);
          if (const auto map = filter.mapInPlane()) {
            const double deviation = deviationOf(*map, drive.truth());
            ASSERT_LT(deviation, 6.0)
                << size << " m off at " << outlier << ", seed " << seed << ", after " << i;
            ++starts;
            large += deviation > 4.0 ? 1 : 0;
          }
        }
        ASSERT_TRUE(filter.mapInPlane()) << size << " m off at " << outlier;
      }
    }
  }
  EXPECT_LT(large, 0.005 * starts) << "of " << starts;
}

TEST(EarthFrameFilter, FixesThatContradictEachOtherStartNothing) {
  const EarthFrameOptions options;
  Drive drive(3, 0.5, options);
  EarthFrameFilter filter(options);
  for (int i = 0; i < 60; ++i) {
    EarthFix fix = drive.next();
    if (i % 2 == 0) {
      fix.in_plane += Point2(0.0, 30.0);
    }
    filter.add(fix);
    ASSERT_FALSE(filter.mapInPlane()) << i;
  }
}

TEST(EarthFrameFilter, FixThatIsLeftOutAtTheStartIsCounted) {
  const EarthFrameOptions options;
  Drive drive(4, 0.5, options);
  EarthFrameFilter filter(options);
  for (int i = 0; i < 60; ++i) {
    EarthFix fix = drive.next();
    if (i == 3) {
      fix.in_plane += Point2(0.0, 30.0);
    }
    filter.add(fix);
  }
  EXPECT_EQ(filter.counts().gated, 1U);
  EXPECT_EQ(filter.counts().used, 59U);
}

TEST(ConsistentPairs, PairsThatBendTheFitToThemselvesAreFound) {
  std::vector<PointPair> pairs;
  const Pose2 motion(4e5, -3e5, 2.0);
  for (int i = 0; i < 12; ++i) {
    const Point2 a(2.0 * i, 0.1 * i * i);
    pairs.push_back({a, motion * a, 0.01});
  }
  EXPECT_EQ(consistentPairs(pairs, 13.8).count, 12U);
  EXPECT_LT(consistentPairs(pairs, 13.8).variance_factor, 1e-3);
  pairs.front().b += Point2(0.0, 3.0);
  pairs.back().b += Point2(0.0, 3.0);
  const ConsistentPairs found = consistentPairs(pairs, 13.8);
  EXPECT_EQ(found.count, 10U);
  EXPECT_FALSE(found.fits.front());
  EXPECT_FALSE(found.fits.back());
  EXPECT_LT(found.variance_factor, 1e-3);
}

TEST(ConsistentPairs, FewAreTakenAsTheyAre) {
  EXPECT_EQ(consistentPairs({}, 13.8).count, 0U);
  EXPECT_EQ(consistentPairs({PointPair(), PointPair()}, 13.8).count, 2U);
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
