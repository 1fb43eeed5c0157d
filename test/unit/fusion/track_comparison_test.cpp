// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_comparison.h"

#include <cmath>
#include <limits>
#include <vector>

#include "fusion_tracks.h"
#include <gtest/gtest.h>

namespace datmo::track_comparison_test {
namespace {

constexpr double kRounding = 1e-9;

/// Without tolerance between the sensors.
TrackComparisonOptions exact() {
  TrackComparisonOptions options;
  options.body_std = 0.0;
  options.extent_share = 0.0;
  options.velocity_std = 0.0;
  return options;
}

/// Follows the x axis at 10 m/s, 10 Hz, until `seconds`, `offset` m beside it.
Track withHistory(Track track, double seconds, int points, double offset, double heading = 0.0) {
  for (int i = points - 1; i >= 0; --i) {
    const double t = seconds - 0.1 * i;
    track.history.push_back({Stamp::fromSeconds(t), Pose2(10.0 * t, offset, heading)});
  }
  track.box.center = track.history.back().pose;
  return track;
}

TEST(TrackComparisonTest, TheDistanceIsThatOfBothCovariances) {
  // 0.6 m at 0.08 m^2 and 1 m/s at 0.5 m^2/s^2: 4.5 and 2.
  const Track a = carTrack(10.0, 0.0, 5.0, 0.0);
  const Track b = carTrack(10.6, 0.0, 4.0, 0.0, "stereo");
  EXPECT_NEAR(compare(a, b, exact()).squared_distance, 6.5, kRounding);
}

TEST(TrackComparisonTest, TheRatioIsThatOfBothDensities) {
  const Track a = carTrack(10.0, 0.0, 5.0, 0.0);
  const Track b = carTrack(10.0, 0.0, 5.0, 0.0, "stereo");
  const double one = 1.0 / (std::pow(2.0 * kPi, 2) * 0.08 * 0.5);
  const double unrelated = 0.002 / (2.0 * kPi * 64.0) * std::exp(-0.5 * 25.0 / 64.0);
  EXPECT_NEAR(compare(a, b, exact()).log_likelihood_ratio, std::log(one / unrelated), kRounding);
}

TEST(TrackComparisonTest, SensorsMayDifferAlongABodyMoreThanAcross) {
  const TrackComparisonOptions options;
  const Track a = carTrack(10.0, 0.0, 5.0, 0.0);
  const double along = compare(a, carTrack(11.0, 0.0, 5.0, 0.0), options).squared_distance;
  const double across = compare(a, carTrack(10.0, 1.0, 5.0, 0.0), options).squared_distance;
  // Each of both boxes: (0.25 * 4.5)^2 and (0.25 * 1.8)^2, and 0.3^2.
  EXPECT_NEAR(along, 1.0 / (0.08 + 2.0 * (1.265625 + 0.09)), kRounding);
  EXPECT_NEAR(across, 1.0 / (0.08 + 2.0 * (0.2025 + 0.09)), kRounding);
}

TEST(TrackComparisonTest, IsSymmetricAndDoesNotDependOnTheAxes) {
  const TrackComparisonOptions options;
  const Track a = carTrack(10.0, 0.0, 5.0, 1.0);
  const Track b = carTrack(10.8, 0.5, 4.0, 0.5, "stereo");
  const TrackComparison one = compare(a, b, options);
  const TrackComparison other = compare(b, a, options);
  EXPECT_NEAR(one.squared_distance, other.squared_distance, kRounding);
  EXPECT_NEAR(one.log_likelihood_ratio, other.log_likelihood_ratio, kRounding);
  const auto turned = [](Track track) {
    const TrackCovariance turn = stateRotation(1.0);
    track.state = turn * track.state;
    track.covariance = turn * track.covariance * turn.transpose();
    track.box.center = Pose2(0.0, 0.0, 1.0) * track.box.center;
    return track;
  };
  EXPECT_NEAR(compare(turned(a), turned(b), options).squared_distance, one.squared_distance,
              kRounding);
}

TEST(TrackComparisonTest, EqualClassesSupportOneObjectAndDifferentOnesDoNot) {
  const auto of = [](ObjectClass object_class) {
    Track track = carTrack(10.0, 0.0, 1.5, 0.0);
    track.class_probabilities.fill(0.05);
    track.class_probabilities[static_cast<std::size_t>(object_class)] = 0.8;
    return track;
  };
  const TrackComparisonOptions options;
  const auto ratio = [&](const Track& a, const Track& b) {
    return compare(a, b, options).log_likelihood_ratio;
  };
  const Track unknown = carTrack(10.0, 0.0, 1.5, 0.0);
  const Track person = of(ObjectClass::kPedestrian);
  const double nothing_known = ratio(unknown, unknown);
  EXPECT_NEAR(ratio(unknown, person), nothing_known, kRounding);
  EXPECT_NEAR(ratio(person, person), nothing_known + std::log(5.0 * (0.64 + 4.0 * 0.0025)),
              kRounding);
  EXPECT_LT(ratio(person, of(ObjectClass::kVehicle)), nothing_known - 0.5);
  Track classless = unknown;
  classless.class_probabilities.fill(0.0);
  EXPECT_NEAR(ratio(classless, person), nothing_known, kRounding);
}

TEST(TrackComparisonTest, DistantTracksAreNotEvaluatedFurther) {
  const TrackComparison far =
      compare(carTrack(0.0, 0.0, 5.0, 0.0), carTrack(80.0, 0.0, 5.0, 0.0), {});
  EXPECT_EQ(far.squared_distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(far.log_likelihood_ratio, -std::numeric_limits<double>::infinity());
  // Whatever is near the gate is.
  TrackComparisonOptions options = exact();
  const double edge = std::sqrt(options.gate * 0.08);
  const auto at = [&](double x) {
    return compare(carTrack(0.0, 0.0, 5.0, 0.0), carTrack(x, 0.0, 5.0, 0.0), options);
  };
  EXPECT_LT(at(0.999 * edge).squared_distance, options.gate);
  EXPECT_GT(at(1.001 * edge).squared_distance, options.gate);
  EXPECT_TRUE(std::isfinite(at(1.001 * edge).squared_distance));
}

TEST(ParallelTracksTest, MeansOverTheCommonHistoryDecide) {
  const Track a = withHistory(carTrack(20.0, 0.0, 10.0, 0.0), 2.0, 20, 0.0);
  ParallelTracksOptions options;
  options.distance = 2.0;
  options.heading = 0.35;
  EXPECT_TRUE(areParallel(a, withHistory(carTrack(20.0, 1.9, 10.0, 0.0), 2.0, 20, 1.9), options));
  EXPECT_FALSE(areParallel(a, withHistory(carTrack(20.0, 2.1, 10.0, 0.0), 2.0, 20, 2.1), options));
  EXPECT_TRUE(
      areParallel(a, withHistory(carTrack(20.0, 0.0, 10.0, 0.0), 2.0, 20, 0.0, 0.3), options));
  EXPECT_FALSE(
      areParallel(a, withHistory(carTrack(20.0, 0.0, 10.0, 0.0), 2.0, 20, 0.0, 0.4), options));
}

TEST(ParallelTracksTest, OppositeDirectionsAreNotParallel) {
  const Track a = withHistory(carTrack(20.0, 0.0, 10.0, 0.0), 2.0, 20, 0.0);
  EXPECT_FALSE(areParallel(a, withHistory(carTrack(20.0, 0.0, -10.0, 0.0), 2.0, 20, 0.0, kPi), {}));
}

TEST(ParallelTracksTest, OtherTimesAreInterpolatedAndTheShorterHistoryCounts) {
  const Track a = withHistory(carTrack(20.0, 0.0, 10.0, 0.0), 2.0, 20, 0.0);
  // Between the points of the other one: the same line, although no stamps are equal.
  const Track late = withHistory(carTrack(19.5, 0.0, 10.0, 0.0), 1.95, 10, 0.0);
  EXPECT_TRUE(areParallel(a, late, {}));
  // Far off before they had any time in common: that does not count.
  Track wild = a;
  for (int i = 0; i < 10; ++i) {
    wild.history[static_cast<std::size_t>(i)].pose = Pose2(0.0, 500.0, 0.0);
  }
  const Track young = withHistory(carTrack(20.0, 0.0, 10.0, 0.0), 2.0, 10, 0.0);
  EXPECT_TRUE(areParallel(young, wild, {}));
  EXPECT_FALSE(areParallel(a, wild, {}));
}

TEST(ParallelTracksTest, WithoutHistoryTheCurrentStateCounts) {
  const Track a = carTrack(20.0, 0.0, 10.0, 0.0);
  EXPECT_TRUE(areParallel(a, carTrack(20.5, 0.5, 10.0, 0.0), {}));
  EXPECT_FALSE(areParallel(a, carTrack(20.5, 2.5, 10.0, 0.0), {}));
}

}  // namespace
}  // namespace datmo::track_comparison_test
