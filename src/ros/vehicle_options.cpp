// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/vehicle_options.h"

namespace datmo {

void VehicleOptions::visit(OptionVisitor& visitor) {
  body.visit(visitor);
  visitor.number({"height", "m", "height of its roof above the ground, as drawn", Tier::kPublic},
                 height, {0.05, 10.0});
  visitor.group("own_points", [&] { own_points.visit(visitor); });
}

}  // namespace datmo
