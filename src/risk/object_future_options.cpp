// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "datmo_fusion/risk/object_futures.h"

namespace datmo {

void HorizonOptions::visit(OptionVisitor& visitor) {
  visitor.number({"horizon", "s",
                  "how far the futures reach: contact within 1, 2, 3 and 4 s is reported; the "
                  "thesis's h (5.3.5), which it leaves open"},
                 horizon, {4.0, 10.0});
  visitor.number({"step", "s",
                  "of the futures; between two steps bodies move evenly, and no contact is missed"},
                 step, {0.02, 0.5});
  visitor.integer({"futures", "1",
                   "joint futures of host and objects; the standard deviation of a probability of "
                   "one half is 0.03 with 256"},
                  futures, {16, 4096});
  visitor.integer({"seed", "1", "of the random numbers: the same seed gives the same risks"}, seed,
                  {0, 1000000});
}

std::size_t HorizonOptions::steps() const {
  return static_cast<std::size_t>(std::llround(std::ceil(horizon / step - 1e-9)));
}

void ObjectFutureOptions::visit(OptionVisitor& visitor) {
  constexpr Bounds kTurning{0.0, 3.0};
  visitor.number({"vehicle_turning", "rad/sqrt(s)",
                  "random walk of the course of a vehicle between turns: 0.4 m/s to the side after "
                  "1 s at 14 m/s, as drivers sway in their lane"},
                 vehicle_turning, kTurning);
  visitor.number({"cyclist_turning", "rad/sqrt(s)", "the same of cyclists and of unknown objects"},
                 cyclist_turning, kTurning);
  visitor.number({"pedestrian_turning", "rad/sqrt(s)",
                  "the same of pedestrians, who change direction easily (thesis 5.3.5)"},
                 pedestrian_turning, kTurning);
  visitor.number({"turning_time", "s",
                  "time constant with which who drives or rides comes back to his course"},
                 turning_time, {0.1, 100.0});
  visitor.number({"start_acceleration", "m/s^2",
                  "standard deviation of the acceleration of what begins to accelerate or brake"},
                 start_acceleration, {0.0, 10.0});
  visitor.number({"stop_deceleration", "m/s^2", "with which an object comes to stand"},
                 stop_deceleration, {0.1, 10.0});
  visitor.number({"max_acceleration", "m/s^2", "no road user accelerates or brakes harder"},
                 max_acceleration, {0.1, 15.0});
  visitor.number({"max_lateral", "m/s^2", "no road user turns harder"}, max_lateral, {0.1, 12.0});
  visitor.group("road_following", [&] { road_following.visit(visitor); });
}

}  // namespace datmo
