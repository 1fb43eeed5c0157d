// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/class_by_speed.h"

#include <algorithm>
#include <cmath>

namespace datmo {

void ClassBySpeedOptions::visit(OptionVisitor& visitor) {
  visitor.number({"pedestrian_speed", "m/s",
                  "few people are faster on foot: 1.4 m/s is the mean of those who walk, 2.5 m/s "
                  "is a jog"},
                 pedestrian_speed, {0.1, 20.0});
  visitor.number({"cyclist_speed", "m/s", "few cyclists are faster"}, cyclist_speed, {0.1, 50.0});
  visitor.number({"spread", "m/s", "by which the faster ones are, as a standard deviation"}, spread,
                 {0.01, 20.0});
}

ClassProbabilities weighedBySpeed(const ClassProbabilities& said, double speed,
                                  const ClassBySpeedOptions& options) {
  ClassProbabilities result = said;
  const auto pass = [&](ObjectClass slower, ObjectClass faster, double usual) {
    const double beyond = std::max(0.0, speed - usual) / options.spread;
    double& of_slower = result[static_cast<std::size_t>(slower)];
    const double passed = of_slower * (1.0 - std::exp(-0.5 * beyond * beyond));
    of_slower -= passed;
    result[static_cast<std::size_t>(faster)] += passed;
  };
  pass(ObjectClass::kPedestrian, ObjectClass::kCyclist, options.pedestrian_speed);
  pass(ObjectClass::kCyclist, ObjectClass::kVehicle, options.cyclist_speed);
  return result;
}

}  // namespace datmo
