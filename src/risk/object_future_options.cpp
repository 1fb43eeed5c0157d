// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "datmo_fusion/risk/object_futures.h"

namespace datmo {

void HorizonOptions::visit(OptionVisitor& visitor) {
  visitor.number({"horizon", "s",
                  "how far ahead the futures reach: contact within 1, 2, 3 and 4 s is reported; h "
                  "of thesis 5.3.5, which leaves it open"},
                 horizon, {4.0, 10.0});
  visitor.number({"step", "s",
                  "time step of the futures; between two steps bodies move uniformly, and no "
                  "contact is missed"},
                 step, {0.02, 0.5});
  visitor.integer({"futures", "1",
                   "number of joint futures of host and objects; with 256, the standard deviation "
                   "of a probability of one half is 0.03"},
                  futures, {16, 4096});
  visitor.integer({"seed", "1", "seed of the random numbers: the same seed gives the same risks"},
                  seed, {0, 1000000});
}

std::size_t HorizonOptions::steps() const {
  return static_cast<std::size_t>(std::llround(std::ceil(horizon / step - 1e-9)));
}

void ObjectFutureOptions::visit(OptionVisitor& visitor) {
  visitor.number({"vehicle_turning", "rad/sqrt(s)",
                  "random walk of the course of a vehicle between turns: 0.4 m/s to the side after "
                  "1 s at 14 m/s, as drivers sway in their lane"},
                 vehicle_turning, {0.0, 3.0});
  visitor.number(
      {"turning_time", "s", "time constant with which a driver or rider returns to the course"},
      turning_time, {0.1, 100.0});
  visitor.number({"max_acceleration", "m/s^2", "no road user accelerates or brakes harder"},
                 max_acceleration, {0.1, 15.0});
  visitor.number({"max_lateral", "m/s^2", "no road user has a larger lateral acceleration"},
                 max_lateral, {0.1, 12.0});
  visitor.group("road_following", [&] { road_following.visit(visitor); });
}

}  // namespace datmo
