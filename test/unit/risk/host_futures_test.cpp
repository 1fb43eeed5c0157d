// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/host_futures.h"

#include <cmath>

#include <gtest/gtest.h>

namespace datmo::host_futures_test {
namespace {

constexpr double kSpeed = 10.0;  ///< m/s

/// Root mean squares of the futures' distances from the nominal path, m.
struct Spread {
  double along = 0.0;
  double aside = 0.0;
};

Spread spreadAt(std::size_t step, const HostFutureOptions& options, double speed = kSpeed) {
  HorizonOptions horizon;
  horizon.futures = 2000;
  HostState host;
  host.speed = speed;
  const HostVehicleOptions vehicle;
  const HostFutures futures(host, std::nullopt, vehicle, options, horizon, RandomDraws(1));
  Spread spread;
  for (const BodyPath& path : futures.paths()) {
    const Point2 off = path.poses[step].center - futures.nominal().poses[step].center;
    spread.along += off.x() * off.x();
    spread.aside += off.y() * off.y();
  }
  const auto count = static_cast<double>(futures.paths().size());
  return {std::sqrt(spread.along / count), std::sqrt(spread.aside / count)};
}

HostFutureOptions onlyLane() {
  HostFutureOptions options;
  options.acceleration_spread = 0.0;
  options.steering_spread = 0.0;
  return options;
}

TEST(HostFutures, ADriverStaysInHisLaneHoweverFarAhead) {
  const HostFutureOptions options = onlyLane();
  EXPECT_LT(spreadAt(5, options).aside, 0.3);
  EXPECT_NEAR(spreadAt(20, options).aside, options.lane_deviation, 0.12);
  EXPECT_LT(spreadAt(20, options).along, 0.1);
}

TEST(HostFutures, ADriverWhoSteersFasterThanAStepDoesNotOscillate) {
  HostFutureOptions options = onlyLane();
  options.lane_deviation = 0.0;
  options.steering_spread = 0.1;
  const double usual = spreadAt(20, options).aside;
  options.steering_time = 0.05;
  EXPECT_NEAR(spreadAt(20, options).aside, usual, 0.4 * usual);
}

TEST(HostFutures, CourseUncertaintyGrowsWithTheSquareOfTime) {
  HostFutureOptions options = onlyLane();
  options.lane_deviation = 0.0;
  options.steering_spread = 0.1;
  // Half of it times t^2, less the delay of the driver's steering.
  EXPECT_NEAR(spreadAt(20, options).aside, 0.5 * 0.1 * 16.0, 0.2);
  EXPECT_GT(spreadAt(20, options).aside, 3.0 * spreadAt(10, options).aside);
}

TEST(HostFutures, AnAccelerationThatVariesLeadsLessFarThanOneThatStays) {
  HostFutureOptions options = onlyLane();
  options.acceleration_spread = 0.5;
  options.acceleration_time = 100.0;
  const double kept = spreadAt(20, options).along;
  EXPECT_NEAR(kept, 0.5 * 0.5 * 16.0, 0.3);
  options.acceleration_time = 2.0;
  // Gauss-Markov: s^2 T^4 (2/3 n^3 - n^2 + 2 - 2 (1 + n) e^-n), n = t / T.
  EXPECT_NEAR(spreadAt(20, options).along, 3.2, 0.35);
}

TEST(HostFutures, AMeasuredAccelerationBeginsWithItsOwnNoise) {
  constexpr std::size_t kStep = 2;  // 0.4 s: hardly any time for the driver to vary it
  HostFutureOptions options = onlyLane();
  options.lane_deviation = 0.0;
  options.acceleration_spread = 0.5;
  HorizonOptions horizon;
  horizon.futures = 2000;
  const auto spread = [&](std::optional<double> sigma) {
    HostState host;
    host.speed = kSpeed;
    host.acceleration = -6.0;
    host.acceleration_sigma = sigma;
    const HostVehicleOptions vehicle;
    const HostFutures futures(host, std::nullopt, vehicle, options, horizon, RandomDraws(1));
    // 10^2 / (2 6) m
    EXPECT_NEAR(futures.nominal().poses.back().center.x() - vehicle.middleAhead(), 8.33, 0.1);
    double sum = 0.0;
    for (const BodyPath& path : futures.paths()) {
      sum += std::pow(path.poses[kStep].center.x() - futures.nominal().poses[kStep].center.x(), 2);
    }
    return std::sqrt(sum / static_cast<double>(futures.paths().size()));
  };
  EXPECT_NEAR(spread(std::nullopt), 0.5 * 0.5 * 0.4 * 0.4, 0.01);
  EXPECT_LT(spread(0.05), 0.7 * spread(std::nullopt));
}

// More than half a turn within the horizon, to either side.
TEST(HostFutures, CurvatureIsThatOfTheCircleDriven) {
  constexpr double kRadius = 5.5;  // m, at 4.5 m/s^2, less than what tires hold
  const HostVehicleOptions vehicle;
  for (const double side : {1.0, -1.0}) {
    HostState host;
    host.speed = 5.0;
    host.steering = side * std::atan(vehicle.wheelbase / kRadius);
    const HostFutures futures(host, std::nullopt, vehicle, {}, {}, RandomDraws(1));
    EXPECT_NEAR(futures.curvature(), side / kRadius, 0.01);
  }
}

TEST(HostFutures, AStationaryHostDoesNotSway) {
  const Spread spread = spreadAt(20, onlyLane(), 0.0);
  EXPECT_EQ(spread.aside, 0.0);
  EXPECT_EQ(spread.along, 0.0);
}

TEST(HostFutures, FollowTheRoadAsOftenAsItIsProbable) {
  HostState host;
  host.speed = 8.0;
  host.steering = -0.1;  // to the right
  const RandomDraws draws(1);
  HorizonOptions horizon;
  horizon.futures = 400;
  const HostVehicleOptions vehicle;
  const HostFutureOptions options;
  for (const double probability : {0.0, 0.3, 1.0}) {
    const HostFutures futures(host, CourseSteering{0.1, 0.0, probability}, vehicle, options,
                              horizon, draws);
    int to_left = 0;
    for (const BodyPath& path : futures.paths()) {
      to_left += path.poses.back().center.y() > 0.0 ? 1 : 0;
    }
    EXPECT_NEAR(to_left / 400.0, probability, 0.06);
    EXPECT_EQ(futures.curvature() > 0.0, probability > 0.5);
  }
}

}  // namespace
}  // namespace datmo::host_futures_test
