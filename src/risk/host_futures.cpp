// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/host_futures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

enum HostDraw : std::uint32_t { kDrawAcceleration, kDrawSteering, kDrawVariation };
constexpr std::uint32_t kHost = 0;  ///< no track has this id

/// m/s; slower, a lateral acceleration is no steering.
constexpr double kSteered = 1.0;

/// How a driver's acceleration and position in the lane vary, step by step.
class DriverVariation {
 public:
  DriverVariation(const HostFutureOptions& options, double step)
      : options_(options), step_(step), kept_(std::exp(-step / options.acceleration_time)) {}

  /// m/s^2, of the first step.
  void begin(double normal) { acceleration_ = options_.acceleration_spread * normal; }

  void advance(double first, double second) {
    acceleration_ = kept_ * acceleration_ +
                    options_.acceleration_spread * std::sqrt(1.0 - kept_ * kept_) * first;
    // e'' = w - 2 f e' - f^2 e: white noise w of density 4 f^3 s^2 makes the deviation s.
    const double frequency = 1.0 / options_.lane_time;
    const double noise = 2.0 * options_.lane_deviation *
                         std::sqrt(frequency * frequency * frequency / step_) * second;
    lateral_ = noise - 2.0 * frequency * rate_ - frequency * frequency * deviation_;
    deviation_ += step_ * (rate_ + 0.5 * step_ * lateral_);
    rate_ += step_ * lateral_;
  }

  double acceleration() const { return acceleration_; }  ///< m/s^2, on top of the present one
  double lateral() const { return lateral_; }            ///< m/s^2, to the left

 private:
  const HostFutureOptions& options_;
  double step_;
  double kept_;
  double acceleration_ = 0.0;
  double deviation_ = 0.0;  ///< m, from the course
  double rate_ = 0.0;       ///< m/s
  double lateral_ = 0.0;
};

/// A border in the host's frame.
std::vector<Point2> inFrame(const RoadBorder& border, const Pose2& base) {
  const Pose2 fixed_in_base = base.inverse();
  std::vector<Point2> points;
  points.reserve(border.points.size());
  for (const BorderPoint& point : border.points) {
    points.push_back(fixed_in_base * point.position);
  }
  return points;
}

/// Offset to the left at which a line passes the axis through `ahead` (m), square to the heading.
std::optional<double> offsetAt(const std::vector<Point2>& line, double ahead) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point2& a = line[i];
    const Point2& b = line[i + 1];
    if (a.x() <= ahead && b.x() >= ahead && b.x() > a.x()) {
      return a.y() + (b.y() - a.y()) * (ahead - a.x()) / (b.x() - a.x());
    }
  }
  return std::nullopt;
}

}  // namespace

void HostFutureOptions::visit(OptionVisitor& visitor) {
  visitor.number({"acceleration_spread", "m/s^2",
                  "standard deviation of the host's acceleration about the present one"},
                 acceleration_spread, {0.0, 5.0});
  visitor.number({"acceleration_time", "s", "time constant with which a driver varies it"},
                 acceleration_time, {0.1, 100.0});
  visitor.number({"lane_deviation", "m",
                  "standard deviation of a driver's lateral position in the lane: 0.2 to 0.3 on "
                  "straight roads "
                  "(Verster, Roth, Standard operation procedures for conducting the on-the-road "
                  "driving test, 2011), more in towns"},
                 lane_deviation, {0.0, 5.0});
  visitor.number({"lane_time", "s", "time constant with which a driver comes back to it"},
                 lane_time, {0.3, 10.0});
  visitor.number(
      {"steering_spread", "m/s^2",
       "standard deviation of the lateral acceleration by which the host's course is off: "
       "noise of the yaw rate, and bends to come that no border tells of"},
      steering_spread, {0.0, 5.0});
  visitor.number({"max_steering_spread", "rad",
                  "the same of the steering's angle, where a slow vehicle turns on the spot"},
                 max_steering_spread, {0.0, 0.5});
  visitor.number({"steering_time", "s", "time constant with which a driver comes to a steering"},
                 steering_time, {0.05, 5.0});
  visitor.number({"course_time", "s", "how far ahead a driver looks at the course of the road"},
                 course_time, {0.2, 5.0});
  visitor.number({"min_course_distance", "m", "the same at low speed"}, min_course_distance,
                 {1.0, 50.0});
  visitor.number({"border_probability", "1", "a road's border less probable gives no course"},
                 border_probability, {0.0, 1.0});
}

std::optional<double> courseSteering(const HostState& host, const RoadModel& road,
                                     const HostVehicleOptions& vehicle,
                                     const HostFutureOptions& options) {
  if (host.speed <= 0.0) {
    return std::nullopt;
  }
  const double ahead = std::max(options.min_course_distance, options.course_time * host.speed);
  double weights = 0.0;
  double curvature = 0.0;
  for (const RoadBorder& border : road.borders) {
    if (border.side_street || border.probability < options.border_probability) {
      continue;
    }
    const std::vector<Point2> line = inFrame(border, host.pose);
    const auto here = offsetAt(line, 0.0);
    const auto there = offsetAt(line, ahead);
    if (here && there) {
      const double aside = *there - *here;
      curvature += border.probability * 2.0 * aside / (square(ahead) + square(aside));
      weights += border.probability;
    }
  }
  if (weights == 0.0) {
    return std::nullopt;
  }
  return std::clamp(std::atan(vehicle.wheelbase * curvature / weights), -vehicle.max_steering,
                    vehicle.max_steering);
}

HostFutures::HostFutures(const HostState& host, const std::optional<double>& course,
                         const HostVehicleOptions& vehicle, const HostFutureOptions& options,
                         const HorizonOptions& horizon, const RandomDraws& draws)
    : host_(host), vehicle_(vehicle), options_(options), horizon_(horizon) {
  const double steering = course.value_or(host.steering);
  // Of the bicycle model: lateral acceleration v^2 tan(steering) / wheelbase.
  const double squared_speed = std::max(square(host.speed), std::numeric_limits<double>::min());
  const double spread = std::min(options.max_steering_spread,
                                 options.steering_spread * vehicle.wheelbase / squared_speed);
  nominal_ = nominalPath(steering);
  paths_.reserve(static_cast<std::size_t>(horizon.futures));
  for (int i = 0; i < horizon.futures; ++i) {
    const auto future = static_cast<std::uint32_t>(i);
    const double turn = spread * draws.normal({kHost, future, 0, kDrawSteering});
    paths_.push_back(path(steering + turn, future, draws));
  }
}

void HostFutures::advance(BicycleState& state, double acceleration, double steering) const {
  const double rate = std::clamp((steering - state.steering) / options_.steering_time,
                                 -vehicle_.max_steering_rate, vehicle_.max_steering_rate);
  state = afterStep(state, {acceleration, rate}, horizon_.step, vehicle_);
}

BodyPath HostFutures::nominalPath(double steering) const {
  BicycleState state = bicycleState(host_);
  BodyPath path{horizon_.step, {outlineOf(state, vehicle_)}};
  for (std::size_t i = 0; i < horizon_.steps(); ++i) {
    advance(state, host_.acceleration, steering);
    path.poses.push_back(outlineOf(state, vehicle_));
  }
  return path;
}

BodyPath HostFutures::path(double steering, std::uint32_t future, const RandomDraws& draws) const {
  BicycleState state = bicycleState(host_);
  BodyPath path{horizon_.step, {}};
  path.poses.reserve(horizon_.steps() + 1);
  path.poses.push_back(outlineOf(state, vehicle_));
  DriverVariation driver(options_, horizon_.step);
  driver.begin(draws.normal({kHost, future, 0, kDrawAcceleration}));
  for (std::size_t i = 0; i < horizon_.steps(); ++i) {
    const StepDraws drawn =
        draws.step({kHost, future, static_cast<std::uint32_t>(i), kDrawVariation});
    driver.advance(drawn.first, drawn.second);
    // Of the bicycle model, as above; a vehicle that hardly moves does not sway.
    const double sway = std::abs(state.speed) < kSteered
                            ? 0.0
                            : driver.lateral() * vehicle_.wheelbase / square(state.speed);
    advance(state, host_.acceleration + driver.acceleration(), steering + sway);
    path.poses.push_back(outlineOf(state, vehicle_));
  }
  return path;
}

}  // namespace datmo
