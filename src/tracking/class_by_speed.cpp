// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/class_by_speed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Up to a term that is the same for all.
double logDensity(const ClassSpeed& class_speed, double speed, double speed_std) {
  const double variance = square(class_speed.std) + square(speed_std);
  return -0.5 * (square(speed - class_speed.mean) / variance + std::log(variance));
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

ClassProbabilities weighedBySpeed(const ClassProbabilities& said, double speed, double speed_std,
                                  const ClassBySpeedOptions& options) {
  using OfClass = std::pair<ObjectClass, double>;
  std::array<OfClass, 3> users = {
      {{ObjectClass::kPedestrian, logDensity(options.pedestrian, speed, speed_std)},
       {ObjectClass::kCyclist, logDensity(options.cyclist, speed, speed_std)},
       {ObjectClass::kVehicle, logDensity(options.vehicle, speed, speed_std)}}};
  const double best =
      std::max_element(users.begin(), users.end(), [](const OfClass& a, const OfClass& b) {
        return a.second < b.second;
      })->second;
  double mean = 0.0;
  for (auto& [object_class, likelihood] : users) {
    likelihood = std::exp(likelihood - best);
    mean += likelihood / static_cast<double>(users.size());
  }
  ClassProbabilities result = said;
  for (const auto& [object_class, likelihood] : users) {
    result[static_cast<std::size_t>(object_class)] *= likelihood / mean;
  }
  const double total = std::accumulate(result.begin(), result.end(), 0.0);
  if (total <= 0.0) {  // surely of a class that is never so fast
    return said;
  }
  for (double& probability : result) {
    probability /= total;
  }
  return result;
}

}  // namespace datmo
