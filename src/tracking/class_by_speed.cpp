// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/class_by_speed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// No speed makes a class impossible, relative to the likeliest of the three.
constexpr double kMinLikelihood = 1e-9;

/// Up to a term that is the same for all.
double logDensity(const ClassSpeed& class_speed, const MeasuredSpeed& speed) {
  const double variance = square(class_speed.std) + square(speed.std);
  return -0.5 * (square(speed.value - class_speed.mean) / variance + std::log(variance));
}

/// Of each class, relative to the mean of the three road users.
ClassProbabilities likelihoods(const MeasuredSpeed& speed, const ClassBySpeedOptions& options) {
  using OfClass = std::pair<ObjectClass, double>;
  const std::array<OfClass, 3> users = {
      {{ObjectClass::kPedestrian, logDensity(options.pedestrian, speed)},
       {ObjectClass::kCyclist, logDensity(options.cyclist, speed)},
       {ObjectClass::kVehicle, logDensity(options.vehicle, speed)}}};
  const double best =
      std::max_element(users.begin(), users.end(), [](const OfClass& a, const OfClass& b) {
        return a.second < b.second;
      })->second;
  ClassProbabilities result{};
  double mean = 0.0;
  for (const auto& [object_class, log_density] : users) {
    const double likelihood = std::max(kMinLikelihood, std::exp(log_density - best));
    result[static_cast<std::size_t>(object_class)] = likelihood;
    mean += likelihood / static_cast<double>(users.size());
  }
  for (double& likelihood : result) {
    likelihood = likelihood > 0.0 ? likelihood / mean : 1.0;
  }
  return result;
}

ClassProbabilities normalized(ClassProbabilities relative) {
  const double total = std::accumulate(relative.begin(), relative.end(), 0.0);
  for (double& probability : relative) {
    probability /= total;
  }
  return relative;
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
  ClassProbabilities result = likelihoods(speed, options);
  std::transform(said.begin(), said.end(), result.begin(), result.begin(), std::multiplies<>());
  return normalized(result);
}

ClassProbabilities withoutSpeed(const ClassProbabilities& weighed, const MeasuredSpeed& speed,
                                const ClassBySpeedOptions& options) {
  ClassProbabilities result = likelihoods(speed, options);
  std::transform(weighed.begin(), weighed.end(), result.begin(), result.begin(), std::divides<>());
  return normalized(result);
}

}  // namespace datmo
