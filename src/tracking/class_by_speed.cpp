#include "datmo_fusion/tracking/class_by_speed.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace datmo {

void ClassBySpeedOptions::visit(OptionVisitor& visitor) {
  visitor.number({"pedestrian_speed", "m/s",
                  "few people are faster on foot: 1.4 m/s is the mean of those who walk, 2.5 m/s "
                  "is a jog"},
                 pedestrian_speed, {0.1, 20.0});
  visitor.number({"cyclist_speed", "m/s", "few cyclists are faster"}, cyclist_speed, {0.1, 50.0});
  visitor.number({"spread", "m/s", "by which the faster ones are, as a standard deviation"}, spread,
                 {0.01, 20.0});
  visitor.number({"least_weight", "1",
                  "however fast, a class is not less likely than by this factor: speeds err"},
                 least_weight, {0.0001, 1.0});
}

ClassProbabilities weighedBySpeed(const ClassProbabilities& said, double speed,
                                  const ClassBySpeedOptions& options) {
  const auto weight = [&](double usual) {
    const double faster = std::max(0.0, speed - usual) / options.spread;
    return std::max(options.least_weight, std::exp(-0.5 * faster * faster));
  };
  ClassProbabilities result = said;
  result[static_cast<std::size_t>(ObjectClass::kPedestrian)] *= weight(options.pedestrian_speed);
  result[static_cast<std::size_t>(ObjectClass::kCyclist)] *= weight(options.cyclist_speed);
  const double sum = std::accumulate(result.begin(), result.end(), 0.0);
  for (double& probability : result) {
    probability /= sum;
  }
  return result;
}

}  // namespace datmo
