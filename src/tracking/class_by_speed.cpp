// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/class_by_speed.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Minimum likelihood relative to the most likely class: no speed makes a class impossible.
constexpr double kMinLikelihood = 1e-9;

/// Log density, up to a term that is the same for all.
double logDensity(const ClassSpeed& class_speed, const MeasuredSpeed& speed) {
  const double variance = square(class_speed.std) + square(speed.std);
  return -0.5 * (square(speed.value - class_speed.mean) / variance + std::log(variance));
}

ClassProbabilities factors(const MeasuredSpeed& speed, const ClassBySpeedOptions& options) {
  const double pedestrian = logDensity(options.pedestrian, speed);
  const double cyclist = logDensity(options.cyclist, speed);
  const double vehicle = logDensity(options.vehicle, speed);
  const double best = std::max({pedestrian, cyclist, vehicle});
  const auto likelihood = [best](double log_density) {
    return std::max(kMinLikelihood, std::exp(log_density - best));
  };
  return ofEachClass({likelihood(pedestrian), likelihood(cyclist), likelihood(vehicle)});
}

}  // namespace

void ClassBySpeedOptions::visit(OptionVisitor& visitor) {
  const auto visitSpeed = [&](const std::string& name, const std::string& source,
                              ClassSpeed& speed) {
    visitor.group(name, [&] {
      visitor.number({"mean", "m/s", source}, speed.mean, {0.1, 50.0});
      visitor.number({"std", "m/s", "standard deviation of the speed"}, speed.std, {0.01, 50.0});
    });
  };
  visitSpeed("pedestrian", "1.34 m/s with 0.26 walking (Weidmann 1993); some run", pedestrian);
  visitSpeed("cyclist", "15 to 17 km/h on average (Schleinitz et al. 2017)", cyclist);
  visitSpeed("vehicle", "in cities: from turning and queues to 50 km/h", vehicle);
}

MeasuredSpeed speedOf(const StateEstimate& estimate) {
  const Eigen::Vector2d velocity = estimate.mean.segment<2>(2);
  const Eigen::Matrix2d covariance = estimate.covariance.block<2, 2>(2, 2);
  const Eigen::Vector2d along = velocity.normalized();
  const double variance =
      velocity.isZero() ? 0.5 * covariance.trace() : along.dot(covariance * along);
  return {velocity.norm(), std::sqrt(std::max(0.0, variance))};
}

ClassProbabilities withSpeed(const ClassProbabilities& said, const MeasuredSpeed& speed,
                             const ClassBySpeedOptions& options) {
  return posterior(said, factors(speed, options));
}

ClassProbabilities withoutSpeed(const ClassProbabilities& weighted, const MeasuredSpeed& speed,
                                const ClassBySpeedOptions& options) {
  return withoutFactors(weighted, factors(speed, options));
}

}  // namespace datmo
