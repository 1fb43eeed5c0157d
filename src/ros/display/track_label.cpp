// SPDX-License-Identifier: BSD-3-Clause
#include "track_label.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo {

std::string labelText(const TrackMessage& track) {
  const ObjectClass object_class = classFromMessage(track.classification);
  std::string text = "#" + std::to_string(track.id);
  if (object_class != ObjectClass::kUnknown) {
    text += std::string(" ") + nameOf(object_class);
  }
  if (track.moving) {
    std::array<char, 32> speed{};
    std::snprintf(speed.data(), speed.size(), " %.1f m/s",
                  std::hypot(track.velocity.x, track.velocity.y));
    text += speed.data();
  }
  return text;
}

}  // namespace datmo
