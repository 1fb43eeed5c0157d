// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <visualization_msgs/MarkerArray.h>

namespace datmo::samples {

/// Returns null if there is none. Not inlined: a test that dereferences it without a check crashes
/// there, and the compiler would warn about each.
[[gnu::noinline]] inline const visualization_msgs::Marker* find(
    const visualization_msgs::MarkerArray& markers, const std::string& name, int id) {
  for (const visualization_msgs::Marker& marker : markers.markers) {
    if (marker.ns == name && marker.id == id) {
      return &marker;
    }
  }
  return nullptr;
}

}  // namespace datmo::samples
