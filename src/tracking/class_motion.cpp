// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/class_motion.h"

namespace datmo {

void ClassMotionOptions::visit(OptionVisitor& visitor) {
  visitor.group("motion", [&] { motion.visit(visitor); });
  visitor.group("pedestrian", [&] { pedestrian.visit(visitor); });
  visitor.group("cyclist", [&] { cyclist.visit(visitor); });
}

const TargetMotionOptions& ClassMotionOptions::motionOf(ObjectClass object_class) const {
  switch (object_class) {
    case ObjectClass::kPedestrian:
      return pedestrian;
    case ObjectClass::kCyclist:
      return cyclist;
    case ObjectClass::kUnknown:
    case ObjectClass::kVehicle:
    case ObjectClass::kPole:
      break;
  }
  return motion;
}

}  // namespace datmo
