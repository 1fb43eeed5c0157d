// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/own_vehicle.h"

namespace datmo {

void OwnVehicleOptions::visit(OptionVisitor& visitor) {
  visitor.number({"rear", "m",
                  "rear end of the box around the ego vehicle, x of the base frame; points in the "
                  "box are its own and are ignored",
                  Tier::kPublic},
                 rear, {-20.0, 0.0});
  visitor.number({"front", "m", "front end of the box", Tier::kPublic}, front, {0.0, 20.0});
  visitor.number({"half_width", "m", "from the middle of the box to either side, mirrors included",
                  Tier::kPublic},
                 half_width, {0.0, 5.0});
}

}  // namespace datmo
