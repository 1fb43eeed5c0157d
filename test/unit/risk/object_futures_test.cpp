// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/object_futures.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "risk/risk_samples.h"
#include <gtest/gtest.h>

namespace datmo::object_futures_test {
namespace {

const HorizonOptions kHorizon;
const RandomDraws kDraws(1);

/// Sojourn times so long that no mode changes.
ObjectFutureOptions withoutSwitching() {
  ObjectFutureOptions options;
  options.transitions.straight_sojourn = 1e6;
  options.transitions.accelerating_sojourn = 1e6;
  options.transitions.turn_sojourn = 1e6;
  options.transitions.standing_sojourn = 1e6;
  return options;
}

struct Spread {
  Point2 mean = Point2::Zero();
  double sigma = 0.0;  ///< m, root of the mean squared distance from the mean
};

Spread endsOf(const ObjectFutures& futures) {
  std::vector<Point2> ends;
  Spread spread;
  for (int i = 0; i < kHorizon.futures; ++i) {
    ends.push_back(futures.path(static_cast<std::size_t>(i)).poses.back().center);
    spread.mean += ends.back() / kHorizon.futures;
  }
  for (const Point2& end : ends) {
    spread.sigma += (end - spread.mean).squaredNorm() / kHorizon.futures;
  }
  spread.sigma = std::sqrt(spread.sigma);
  return spread;
}

TEST(RandomDraws, AreStandardNormalAndUniform) {
  double sum = 0.0;
  double squares = 0.0;
  double uniforms = 0.0;
  constexpr int kCount = 20000;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double normal = kDraws.normal({3, i, 2, 1});
    sum += normal;
    squares += normal * normal;
    uniforms += kDraws.uniform({3, i, 2, 1});
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.03);
  EXPECT_NEAR(squares / kCount, 1.0, 0.04);
  EXPECT_NEAR(uniforms / kCount, 0.5, 0.01);
}

TEST(RandomDraws, OfOneKeyAreTheSame) {
  const RandomDraws again(1);
  const RandomDraws other(2);
  EXPECT_EQ(kDraws.normal({5, 6, 7, 8}), again.normal({5, 6, 7, 8}));
  EXPECT_NE(kDraws.normal({5, 6, 7, 8}), other.normal({5, 6, 7, 8}));
}

TEST(ObjectFutures, KeepTheirVelocityOnAverage) {
  const Track track = knownTrack(1, {5, 2}, {10, 0});
  const ObjectFutureOptions options = withoutSwitching();
  const Spread spread = endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws));
  EXPECT_NEAR(spread.mean.x(), 45.0, 0.6);
  EXPECT_NEAR(spread.mean.y(), 2.0, 0.6);
}

TEST(ObjectFutures, OfASourceWithoutModesMove) {
  Track track = knownTrack(1, {5, 2}, {10, 0});
  track.mode_probabilities = {};
  const ObjectFutureOptions options = withoutSwitching();
  const Spread spread = endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws));
  EXPECT_NEAR(spread.mean.x(), 45.0, 0.6);
}

TEST(ObjectFutures, SpreadWithTheCovariance) {
  Track track = knownTrack(1, {0, 0}, {10, 0});
  const ObjectFutureOptions options = withoutSwitching();
  const double known = endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws)).sigma;
  track.covariance(3, 3) = 4.0;  // 2 m/s to the side, 8 m after 4 s
  const double uncertain =
      endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws)).sigma;
  EXPECT_NEAR(std::sqrt(uncertain * uncertain - known * known), 8.0, 1.2);
}

TEST(ObjectFutures, StationaryObjectsStay) {
  const Track track = knownTrack(1, {5, 2}, {0, 0});
  const ObjectFutureOptions options = withoutSwitching();
  const Spread spread = endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws));
  EXPECT_NEAR(spread.mean.x(), 5.0, 0.01);
  EXPECT_LT(spread.sigma, 0.05);
}

TEST(ObjectFutures, BrakingObjectsComeToRest) {
  Track track = knownTrack(1, {0, 0}, {6, 0});
  track.mode_probabilities = {0.0, 1.0, 0.0, 0.0, 0.0};
  track.state[4] = -3.0;
  const ObjectFutureOptions options = withoutSwitching();
  const ObjectFutures futures(track, std::nullopt, options, kHorizon, kDraws);
  // v^2 / (2 a).
  EXPECT_NEAR(futures.nominalPath().poses.back().center.x(), 6.0, 0.1);
  EXPECT_NEAR(endsOf(futures).mean.x(), 6.0, 0.4);
}

TEST(ObjectFutures, TurnToTheSideOfTheMode) {
  Track track = knownTrack(1, {0, 0}, {5, 0});
  track.mode_probabilities = {0.0, 0.0, 1.0, 0.0, 0.0};
  const ObjectFutureOptions options = withoutSwitching();
  const BodyPath path = ObjectFutures(track, std::nullopt, options, kHorizon, kDraws).nominalPath();
  const double rate = options.motion.motion.turn_rate;
  EXPECT_NEAR(path.poses.back().heading, 4.0 * rate, 1e-9);
  EXPECT_GT(path.poses.back().center.y(), 5.0);
}

TEST(ObjectFutures, PedestriansTurnMoreFreely) {
  const Track car = knownTrack(1, {0, 0}, {1.5, 0});
  const Track pedestrian = knownTrack(1, {0, 0}, {1.5, 0}, ObjectClass::kPedestrian);
  const ObjectFutureOptions options = withoutSwitching();
  EXPECT_GT(endsOf(ObjectFutures(pedestrian, std::nullopt, options, kHorizon, kDraws)).sigma,
            1.2 * endsOf(ObjectFutures(car, std::nullopt, options, kHorizon, kDraws)).sigma);
}

TEST(ObjectFutures, DriversReturnToTheirCourse) {
  const Track car = knownTrack(1, {0, 0}, {14, 0});
  ObjectFutureOptions options = withoutSwitching();
  options.motion.motion.acceleration_density = 1e-6;
  const double back = endsOf(ObjectFutures(car, std::nullopt, options, kHorizon, kDraws)).sigma;
  options.turning_time = 100.0;
  // A random walk of the course: v s sqrt(t^3 / 3).
  const double walk = endsOf(ObjectFutures(car, std::nullopt, options, kHorizon, kDraws)).sigma;
  EXPECT_NEAR(walk, 14.0 * options.vehicle_turning * std::sqrt(64.0 / 3.0), 0.35);
  EXPECT_LT(back, 0.75 * walk);
}

TEST(ObjectFutures, SwitchingModesSpreadThem) {
  const Track track = knownTrack(1, {0, 0}, {10, 0});
  const ObjectFutureOptions kept = withoutSwitching();
  const ObjectFutureOptions switching;
  EXPECT_GT(endsOf(ObjectFutures(track, std::nullopt, switching, kHorizon, kDraws)).sigma,
            1.5 * endsOf(ObjectFutures(track, std::nullopt, kept, kHorizon, kDraws)).sigma);
}

/// How a pedestrian starts from rest.
struct StartFromRest {
  double direction = 0.0;     ///< rad
  double speed = 0.0;         ///< m/s
  double acceleration = 0.0;  ///< m/s^2
};

/// Returns the starts into a mode of many futures, before any other noise.
std::vector<StartFromRest> startsInto(MotionMode mode) {
  constexpr std::size_t kFutures = 20000;
  ObjectFutureOptions options;
  options.pedestrian_turning = 0.0;
  options.motion.pedestrian.acceleration_density = 0.0;
  options.transitions.standing_sojourn = 1e-3;
  HorizonOptions horizon;
  horizon.step = 0.01;
  const Track track = knownTrack(1, {5, 2}, {0, 0}, ObjectClass::kPedestrian);
  const ObjectFutures futures(track, std::nullopt, options, horizon, kDraws);
  std::vector<StartFromRest> starts;
  for (std::size_t i = 0; i < kFutures; ++i) {
    ObjectFutures::State state = futures.begin(i);
    futures.advance(state, i, 0);
    if (state.mode == mode) {
      starts.push_back({std::atan2(state.course.y(), state.course.x()), state.speed,
                        std::abs(state.acceleration)});
    }
  }
  return starts;
}

/// Returns the share of those that start in the same direction that also have the same value.
double shareOfSame(std::vector<StartFromRest> starts, double StartFromRest::*value) {
  constexpr double kSame = 1e-4;  // rad; a quarter of what a random number resolves
  std::sort(starts.begin(), starts.end(), [](const StartFromRest& a, const StartFromRest& b) {
    return a.direction < b.direction;
  });
  int pairs = 0;
  int same = 0;
  for (std::size_t i = 1; i < starts.size(); ++i) {
    if (starts[i].direction - starts[i - 1].direction < kSame) {
      ++pairs;
      same += starts[i].*value == starts[i - 1].*value ? 1 : 0;
    }
  }
  EXPECT_GT(pairs, 100);
  return static_cast<double>(same) / pairs;
}

/// Returns the coefficient of correlation of speed and acceleration.
double correlationOf(const std::vector<StartFromRest>& starts) {
  StartFromRest mean;
  for (const StartFromRest& start : starts) {
    mean.speed += start.speed / static_cast<double>(starts.size());
    mean.acceleration += start.acceleration / static_cast<double>(starts.size());
  }
  double both = 0.0;
  double speeds = 0.0;
  double accelerations = 0.0;
  for (const StartFromRest& start : starts) {
    const double speed = start.speed - mean.speed;
    const double acceleration = start.acceleration - mean.acceleration;
    both += speed * acceleration;
    speeds += speed * speed;
    accelerations += acceleration * acceleration;
  }
  return both / std::sqrt(speeds * accelerations);
}

TEST(ObjectFutures, DirectionSpeedAndAccelerationOfAStartAreIndependent) {
  EXPECT_LT(shareOfSame(startsInto(MotionMode::kConstantVelocity), &StartFromRest::speed), 0.1);
  const std::vector<StartFromRest> accelerating = startsInto(MotionMode::kConstantAcceleration);
  EXPECT_LT(shareOfSame(accelerating, &StartFromRest::acceleration), 0.1);
  EXPECT_NEAR(correlationOf(accelerating), 0.0, 0.1);
}

TEST(HorizonOptions, AStepThatDoesNotDivideTheHorizonReachesBeyondIt) {
  HorizonOptions options;
  EXPECT_EQ(options.steps(), 20U);
  options.step = 0.3;
  EXPECT_EQ(options.steps(), 14U);
}

/// Straight along x.
constexpr RoadCourse kRoad{};

TEST(ObjectFutures, AlongTheRoadDoNotTurnOffLater) {
  const Track car = knownTrack(1, {40, 3.5}, {-10, 0});
  ObjectFutureOptions options;
  options.road_following.probability = 0.999;
  const double free = endsOf(ObjectFutures(car, std::nullopt, options, kHorizon, kDraws)).sigma;
  EXPECT_LT(endsOf(ObjectFutures(car, kRoad, options, kHorizon, kDraws)).sigma, 0.8 * free);
}

TEST(ObjectFutures, TurningObjectsDoNotFollowTheRoad) {
  Track track = vagueOncoming(0.0);
  track.mode_probabilities = {0.0, 0.0, 1.0, 0.0, 0.0};
  const ObjectFutureOptions options = withoutSwitching();
  const double free =
      endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws)).mean.y();
  const double beside = endsOf(ObjectFutures(track, kRoad, options, kHorizon, kDraws)).mean.y();
  EXPECT_LT(free, -5.0) << "it turns left, toward the host's lane";
  EXPECT_EQ(free, beside);
}

TEST(ObjectFutures, AlongTheRoadStayInTheirLane) {
  const Track track = vagueOncoming(1.5);
  const ObjectFutureOptions options = withoutSwitching();
  const double free =
      endsOf(ObjectFutures(track, std::nullopt, options, kHorizon, kDraws)).mean.y();
  const double along = endsOf(ObjectFutures(track, kRoad, options, kHorizon, kDraws)).mean.y();
  EXPECT_LT(free, -2.0);
  EXPECT_NEAR(along, 3.5, 1.5);
}

TEST(ObjectFutures, ObjectsThatJoinTheRoadEndTheirTurnAlongIt) {
  const Track track = joiningCar(0.45);
  ObjectFutureOptions options = withoutSwitching();
  options.road_following.turning = 1.0;
  int along = 0;
  const ObjectFutures futures(track, kRoad, options, kHorizon, kDraws);
  for (std::size_t i = 0; i < 100; ++i) {
    along += std::abs(turnIntoRoad(futures.path(i).poses.back().heading, 0.0)) < 0.2 ? 1 : 0;
  }
  EXPECT_GT(along, 70);
}

// On an arc of 100 m radius: after 4 s at 10 m/s 0.4 rad, in either direction.
TEST(ObjectFutures, RoadFollowersBendWithIt) {
  ObjectFutureOptions options = withoutSwitching();
  options.road_following.probability = 0.999;
  const RoadCourse bend{0.0, 0.01};
  for (const double speed : {10.0, -10.0}) {
    const Track car = knownTrack(1, {40, 3.5}, {speed, 0});
    const BodyPath path = ObjectFutures(car, bend, options, kHorizon, kDraws).nominalPath();
    EXPECT_NEAR(path.poses.back().heading - path.poses.front().heading, std::copysign(0.4, speed),
                0.01);
  }
}

}  // namespace
}  // namespace datmo::object_futures_test
