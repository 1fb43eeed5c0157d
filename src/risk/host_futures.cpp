// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/risk/host_futures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/normal_density.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

enum HostDraw : std::uint32_t { kDrawAcceleration, kDrawSteering, kDrawVariation, kDrawIntention };
constexpr std::uint32_t kHost = 0;  ///< no track has this id

/// m/s; below this, a lateral acceleration does not define a steering angle.
constexpr double kSteered = 1.0;

/// Random variation of a driver's acceleration and position in the lane, step by step.
class DriverVariation {
 public:
  DriverVariation(const HostFutureOptions& options, double step)
      : options_(options), step_(step), kept_(std::exp(-step / options.acceleration_time)) {}

  /// Starts with the first step's acceleration, m/s^2, in addition to the current one.
  void begin(double acceleration) { acceleration_ = acceleration; }

  void advance(double first, double second) {
    acceleration_ = kept_ * acceleration_ +
                    options_.acceleration_spread * std::sqrt(1.0 - kept_ * kept_) * first;
    // e'' = w - 2 f e' - f^2 e: white noise w of density 4 f^3 s^2 gives a standard deviation of s.
    const double frequency = 1.0 / options_.lane_time;
    const double noise = 2.0 * options_.lane_deviation *
                         std::sqrt(frequency * frequency * frequency / step_) * second;
    lateral_ = noise - 2.0 * frequency * rate_ - frequency * frequency * deviation_;
    deviation_ += step_ * (rate_ + 0.5 * step_ * lateral_);
    rate_ += step_ * lateral_;
  }

  double acceleration() const { return acceleration_; }  ///< m/s^2, in addition to the current one
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

/// m; no border is more accurate.
constexpr double kMinSigma = 0.02;

/// Returns a border's points in the host's frame.
std::vector<BorderPoint> inFrame(const RoadBorder& border, const Pose2& base) {
  const Pose2 fixed_in_base = base.inverse();
  std::vector<BorderPoint> points;
  points.reserve(border.points.size());
  for (const BorderPoint& point : border.points) {
    points.push_back({fixed_in_base * point.position, point.sigma});
  }
  return points;
}

/// Returns where a border crosses the axis through `ahead` (m), perpendicular to the heading.
std::optional<BorderPoint> pointAt(const std::vector<BorderPoint>& border, double ahead) {
  for (std::size_t i = 0; i + 1 < border.size(); ++i) {
    const Point2& a = border[i].position;
    const Point2& b = border[i + 1].position;
    if (a.x() <= ahead && b.x() >= ahead && b.x() > a.x()) {
      const double share = (ahead - a.x()) / (b.x() - a.x());
      return BorderPoint{a + share * (b - a), std::max(border[i].sigma, border[i + 1].sigma)};
    }
  }
  return std::nullopt;
}

/// Curvature (1/m) of the arc from here to a point ahead at the same distance from a border.
struct Curvature {
  double value = 0.0;
  double variance = 0.0;
};

/// `here`, `there`: of one border, in the host's frame.
Curvature curvatureBetween(const BorderPoint& here, const BorderPoint& there) {
  const double aside = there.position.y() - here.position.y();
  const double per_offset = 2.0 / (square(there.position.x()) + square(aside));
  return {per_offset * aside,
          square(per_offset) * (square(here.sigma) + square(there.sigma) + square(kMinSigma))};
}

/// Returns the probability that a driver follows the road with this border rather than turns off
/// it, by the border's direction. `from`, `to`: of the border, in the host's frame.
double followProbability(const BorderPoint& from, const BorderPoint& to, double speed,
                         const HostFutureOptions& options) {
  const Point2 along = to.position - from.position;
  const double sway = options.lane_deviation / (options.lane_time * std::max(speed, kSteered));
  const double variance =
      square(sway) +
      (square(from.sigma) + square(to.sigma) + square(kMinSigma)) / along.squaredNorm();
  const double follows =
      (1.0 - options.turning_share) * normalDensity(std::atan2(along.y(), along.x()), variance);
  const double turns = options.turning_share / kPi;  // any direction ahead
  return follows / (follows + turns);
}

double curvatureOf(const BodyPath& path) {
  constexpr double kShortPath = 1.0;  // m; a shorter path does not define a curvature
  double length = 0.0;
  double turn = 0.0;
  for (std::size_t i = 0; i + 1 < path.poses.size(); ++i) {
    length += (path.poses[i + 1].center - path.poses[i].center).norm();
    turn += angleBetween(path.poses[i].heading, path.poses[i + 1].heading);
  }
  return length > kShortPath ? turn / length : 0.0;
}

}  // namespace

void HostFutureOptions::visit(OptionVisitor& visitor) {
  visitor.number({"acceleration_spread", "m/s^2",
                  "standard deviation of the host's acceleration about its current value"},
                 acceleration_spread, {0.0, 5.0});
  visitor.number({"acceleration_time", "s", "time constant with which a driver varies it"},
                 acceleration_time, {0.1, 100.0});
  visitor.number({"lane_deviation", "m",
                  "standard deviation of a driver's lateral position in the lane: 0.2 to 0.3 on "
                  "straight roads (Verster, Roth, Standard operation procedures for conducting the "
                  "on-the-road driving test, 2011), more in towns"},
                 lane_deviation, {0.0, 5.0});
  visitor.number({"steering_spread", "m/s^2",
                  "standard deviation of the error of the host's course, as a lateral "
                  "acceleration: noise of the yaw rate, and bends ahead that no border shows"},
                 steering_spread, {0.0, 5.0});
  visitor.number({"steering_time", "s",
                  "time constant with which a driver reaches the intended steering angle"},
                 steering_time, {0.05, 5.0});
}

std::optional<CourseSteering> courseSteering(const HostState& host, const RoadModel& road,
                                             const HostVehicleOptions& vehicle,
                                             const HostFutureOptions& options) {
  if (host.speed <= 0.0) {
    return std::nullopt;
  }
  const double ahead = std::max(options.min_course_distance, options.course_time * host.speed);
  // Beside the vehicle, where the chord of a bend is parallel to it.
  const double beside = 0.5 * options.min_course_distance;
  double weights = 0.0;
  double curvature = 0.0;
  double probability = 0.0;
  for (const RoadBorder& border : road.borders) {
    if (border.side_street || border.probability < options.border_probability) {
      continue;
    }
    const std::vector<BorderPoint> points = inFrame(border, host.pose);
    const auto here = pointAt(points, 0.0);
    const auto rear = pointAt(points, -beside);
    const auto front = pointAt(points, beside);
    const auto there = pointAt(points, ahead);
    if (here && front && there) {
      const Curvature arc = curvatureBetween(*here, *there);
      const double follows = followProbability(rear.value_or(*here), *front, host.speed, options);
      const double weight = border.probability * follows / arc.variance;
      curvature += weight * arc.value;
      weights += weight;
      probability = std::max(probability, follows);
    }
  }
  if (weights <= 0.0) {
    return std::nullopt;
  }
  // Of a driver who follows the road.
  const double sigma = vehicle.wheelbase / std::sqrt(weights / probability);
  if (sigma > options.max_steering_spread) {
    return std::nullopt;
  }
  return CourseSteering{std::clamp(std::atan(vehicle.wheelbase * curvature / weights),
                                   -vehicle.max_steering, vehicle.max_steering),
                        sigma, probability};
}

HostFutures::HostFutures(const HostState& host, const std::optional<CourseSteering>& course,
                         const HostVehicleOptions& vehicle, const HostFutureOptions& options,
                         const HorizonOptions& horizon, const RandomDraws& draws)
    : host_(host), vehicle_(vehicle), options_(options), horizon_(horizon) {
  // Bicycle model: lateral acceleration v^2 tan(steering) / wheelbase.
  const double squared_speed = std::max(square(host.speed), std::numeric_limits<double>::min());
  const CourseSteering kept{host.steering,
                            std::min(options.max_steering_spread,
                                     options.steering_spread * vehicle.wheelbase / squared_speed)};
  const CourseSteering followed =
      course ? CourseSteering{course->angle, std::hypot(kept.sigma, course->sigma),
                              course->probability}
             : CourseSteering{0.0, 0.0, 0.0};
  nominal_ = nominalPath(followed.probability >= 0.5 ? followed.angle : kept.angle);
  curvature_ = curvatureOf(nominal_);
  paths_.reserve(static_cast<std::size_t>(horizon.futures));
  for (int i = 0; i < horizon.futures; ++i) {
    const auto future = static_cast<std::uint32_t>(i);
    const bool follows = draws.uniform({kHost, future, 0, kDrawIntention}) < followed.probability;
    const CourseSteering& intended = follows ? followed : kept;
    const double turn = intended.sigma * draws.normal({kHost, future, 0, kDrawSteering});
    paths_.push_back(path(intended.angle + turn, future, draws));
  }
}

void HostFutures::advance(BicycleState& state, double acceleration, double steering) const {
  const double rate =
      std::clamp((steering - state.steering) / std::max(options_.steering_time, horizon_.step),
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
  driver.begin(host_.acceleration_sigma.value_or(options_.acceleration_spread) *
               draws.normal({kHost, future, 0, kDrawAcceleration}));
  for (std::size_t i = 0; i < horizon_.steps(); ++i) {
    const StepDraws drawn =
        draws.step({kHost, future, static_cast<std::uint32_t>(i), kDrawVariation});
    driver.advance(drawn.first, drawn.second);
    // Bicycle model, as above; a vehicle that hardly moves does not sway.
    const double sway = std::abs(state.speed) < kSteered
                            ? 0.0
                            : driver.lateral() * vehicle_.wheelbase / square(state.speed);
    advance(state, host_.acceleration + driver.acceleration(), steering + sway);
    path.poses.push_back(outlineOf(state, vehicle_));
  }
  return path;
}

}  // namespace datmo
