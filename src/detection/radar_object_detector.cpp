// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/radar_object_detector.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Core>

#include "datmo_fusion/common/disjoint_sets.h"
#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/range_bearing.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Maximum distance of returns from one object, in standard deviations of the bearing.
constexpr double kBearingSigmas = 3.0;

/// m; extent of an object without visible extent.
constexpr double kMinExtent = 0.5;

}  // namespace

void RadarObjectDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.number({"range_sigma", "m", "standard deviation of a range (data sheet)"}, range_sigma,
                 {0.001, 10.0});
  visitor.number({"bearing_sigma", "rad", "standard deviation of a bearing (data sheet)"},
                 bearing_sigma, {1e-4, 0.5});
  visitor.number(
      {"range_rate_sigma", "m/s", "standard deviation of a Doppler velocity (data sheet)"},
      range_rate_sigma, {0.001, 10.0});
  visitor.number({"own_speed_sigma", "m/s", "standard deviation of the vehicle's own speed"},
                 own_speed_sigma, {0.0, 10.0});
  visitor.number({"cluster_distance", "m",
                  "returns closer to each other than this, plus what the noise of their bearings "
                  "allows, belong to one object"},
                 cluster_distance, {0.1, 20.0});
  visitor.number({"cluster_speed", "m/s", "largest difference between their velocities"},
                 cluster_speed, {0.05, 20.0});
  visitor.integer(
      {"min_returns", "",
       "returns nearby, itself included, that a return needs to start or join a cluster"},
      min_returns, {1.0, 100.0});
  visitor.number(
      {"reflection_sigma", "m",
       "standard deviation, along each axis, of the point that reflects about the middle of the "
       "object: for a uniform distribution over a car, 1.3 m along and 0.5 m across"},
      reflection_sigma, {0.0, 10.0});
  visitor.number({"tangential_sigma", "m/s",
                  "standard deviation of the velocity across the line of sight, which is not "
                  "measured"},
                 tangential_sigma, {0.1, 100.0});
  visitor.number({"min_speed", "m/s",
                  "returns that are slower along the line of sight are stationary or cross it, and "
                  "are dropped"},
                 min_speed, {0.0, 50.0});
  visitor.number(
      {"wrong_velocity", "1",
       "probability that a velocity is that of something else: a wheel, a leg, a mirror image"},
      wrong_velocity, {0.0, 1.0});
}

struct RadarObjectDetector::Detection {
  Point2 position = Point2::Zero();
  double range = 0.0;           ///< m, from the radar
  double speed = 0.0;           ///< m/s over the ground, away from the radar
  double speed_variance = 0.0;  ///< (m/s)^2, due to the error of the bearing
};

RadarObjectDetector::RadarObjectDetector(const Checked<RadarObjectDetectorOptions>& options)
    : options_(*options) {}

std::vector<RadarObjectDetector::Detection> RadarObjectDetector::detectionsOf(
    const RadarCycle& cycle, const Twist2& twist) const {
  const Point2 lever = cycle.radar_in_base.position();
  const Point2 own = Point2(twist.forward_speed, 0.0) + twist.yaw_rate * perpendicular(lever);
  std::vector<Detection> detections;
  for (const RadarReturn& one : cycle.returns) {
    const Point2 along =
        cycle.radar_in_base.rotate(Point2(std::cos(one.bearing), std::sin(one.bearing)));
    Detection detection;
    detection.position = lever + one.range * along;
    detection.range = one.range;
    detection.speed = one.range_rate + own.dot(along);
    // A bearing error mixes part of the lateral motion of both into the radial one.
    detection.speed_variance =
        square(options_.bearing_sigma) *
        (square(own.dot(perpendicular(along))) + square(options_.tangential_sigma));
    detections.push_back(detection);
  }
  return detections;
}

bool RadarObjectDetector::areNear(const Detection& a, const Detection& b) const {
  const double apart = options_.cluster_distance +
                       kBearingSigmas * options_.bearing_sigma * std::max(a.range, b.range);
  return std::abs(a.speed - b.speed) <= options_.cluster_speed &&
         (a.position - b.position).squaredNorm() <= square(apart);
}

std::vector<std::vector<std::size_t>> RadarObjectDetector::clustersOf(
    const std::vector<Detection>& detections) const {
  std::vector<std::vector<std::size_t>> near(detections.size());
  for (std::size_t i = 0; i < detections.size(); ++i) {
    for (std::size_t j = 0; j < detections.size(); ++j) {
      if (areNear(detections[i], detections[j])) {
        near[i].push_back(j);
      }
    }
  }
  const auto is_core = [&](std::size_t i) {
    return near[i].size() >= static_cast<std::size_t>(options_.min_returns);
  };
  DisjointSets sets(detections.size());
  for (std::size_t i = 0; i < detections.size(); ++i) {
    // A return at the edge belongs to the first core nearby.
    bool has_core = is_core(i);
    for (const std::size_t j : near[i]) {
      if (is_core(j) && (is_core(i) || !has_core)) {
        sets.join(i, j);
        has_core = true;
      }
    }
  }
  std::vector<std::vector<std::size_t>> clusters;
  for (std::vector<std::size_t>& set : sets.sets()) {
    if (std::any_of(set.begin(), set.end(), is_core)) {
      clusters.push_back(std::move(set));
    }
  }
  return clusters;
}

Object RadarObjectDetector::objectOf(const std::vector<Detection>& detections,
                                     const std::vector<std::size_t>& cluster,
                                     const Point2& radar) const {
  const auto count = static_cast<double>(cluster.size());
  Point2 middle = Point2::Zero();
  double speed = 0.0;
  double speed_variance = 0.0;
  for (const std::size_t i : cluster) {
    middle += detections[i].position / count;
    speed += detections[i].speed / count;
    speed_variance += detections[i].speed_variance / count;
  }
  const Point2 from_radar = middle - radar;
  const Point2 along = from_radar.normalized();
  const Point2 across = perpendicular(along);
  Eigen::Array2d extent = Eigen::Array2d::Constant(0.5 * kMinExtent);
  for (const std::size_t i : cluster) {
    const Point2 off = detections[i].position - middle;
    extent = extent.max(Eigen::Array2d(std::abs(off.dot(along)), std::abs(off.dot(across))));
  }
  Object object;
  object.box = {Pose2(middle, std::atan2(along.y(), along.x())), 2.0 * extent[0], 2.0 * extent[1]};
  object.position_covariance =
      rangeBearingCovariance(from_radar, square(options_.range_sigma) / count,
                             square(options_.bearing_sigma) / count) +
      square(options_.reflection_sigma) * Eigen::Matrix2d::Identity();
  object.side_variance.fill(kHiddenSide);
  // The error of the vehicle's speed counts in proportion to the radar's direction of view.
  const double along_variance = (square(options_.range_rate_sigma) + speed_variance) / count +
                                square(options_.own_speed_sigma * along.x());
  object.velocity =
      MeasuredVelocity{speed * along,
                       along_variance * along * along.transpose() +
                           square(options_.tangential_sigma) * across * across.transpose(),
                       options_.wrong_velocity};
  object.sensors = {"radar"};
  return object;
}

RadarObjects RadarObjectDetector::detect(const RadarCycle& cycle, const Twist2& twist) const {
  const std::vector<Detection> detections = detectionsOf(cycle, twist);
  RadarObjects found;
  found.list.stamp = cycle.stamp;
  found.unclustered = detections.size();
  for (const std::vector<std::size_t>& cluster : clustersOf(detections)) {
    found.unclustered -= cluster.size();
    Object object = objectOf(detections, cluster, cycle.radar_in_base.position());
    if (object.velocity->velocity.norm() < options_.min_speed) {
      ++found.standing;
    } else {
      found.list.objects.push_back(std::move(object));
    }
  }
  return found;
}

}  // namespace datmo
