// SPDX-License-Identifier: BSD-3-Clause
#include "object_names.h"

#include <algorithm>
#include <cmath>

namespace datmo {

namespace {

/// Whether an object's extent or velocity was measured, not only its class.
bool isObservation(const Object& object) {
  const auto& sides = object.side_variance;
  return object.velocity ||
         std::any_of(sides.begin(), sides.end(), [](double side) { return std::isfinite(side); });
}

}  // namespace

std::set<std::string> sensorsOf(const std::string& source, const ObjectList& list) {
  std::set<std::string> sensors{source};
  for (const SensorView& view : list.views) {
    sensors.insert(view.sensor);
  }
  for (const Object& object : list.objects) {
    if (isObservation(object)) {
      sensors.insert(object.sensors.begin(), object.sensors.end());
    }
  }
  return sensors;
}

bool isClassOnly(const Object& object, const std::set<std::string>& sensors_of_others) {
  return !isObservation(object) && !object.sensors.empty() &&
         std::all_of(object.sensors.begin(), object.sensors.end(),
                     [&](const auto& sensor) { return sensors_of_others.count(sensor) > 0; });
}

}  // namespace datmo
