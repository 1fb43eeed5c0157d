// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/common/object.h"

#include "datmo_fusion/common/class_belief.h"

namespace datmo {

const char* nameOf(ObjectClass object_class) {
  switch (object_class) {
    case ObjectClass::kPedestrian:
      return "pedestrian";
    case ObjectClass::kCyclist:
      return "cyclist";
    case ObjectClass::kVehicle:
      return "vehicle";
    case ObjectClass::kPole:
      return "pole";
    case ObjectClass::kUnknown:
      break;
  }
  return "unknown";
}

ObjectClass Object::objectClass() const { return mostLikelyClass(class_probabilities); }

}  // namespace datmo
