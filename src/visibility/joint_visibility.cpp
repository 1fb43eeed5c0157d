// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/joint_visibility.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace datmo {

namespace {

std::vector<Box2> seenBy(const std::string& sensor, const std::vector<Object>& objects) {
  std::vector<Box2> boxes;
  for (const Object& object : objects) {
    if (std::find(object.sensors.begin(), object.sensors.end(), sensor) != object.sensors.end()) {
      boxes.push_back(object.box);
    }
  }
  return boxes;
}

}  // namespace

Visibility jointVisibility(const Visibility* scan, const ObjectList& list,
                           const VisibilityOptions& options) {
  std::optional<Visibility> joint;
  if (scan != nullptr) {
    joint = *scan;
  }
  for (const SensorView& view : list.views) {
    const Visibility own(view.field, seenBy(view.sensor, list.objects), options);
    if (joint) {
      joint->join(own);
    } else {
      joint = own;
    }
  }
  return joint ? *joint : Visibility(options);
}

}  // namespace datmo
