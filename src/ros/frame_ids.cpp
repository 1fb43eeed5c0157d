// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/frame_ids.h"

#include <algorithm>

namespace datmo {

std::string withoutSlash(const std::string& frame) { return std::string(plainName(frame)); }

std::string_view plainName(std::string_view frame) {
  frame.remove_prefix(std::min(frame.find_first_not_of('/'), frame.size()));
  return frame;
}

void noteSlash(const std::string& input, const std::string& slashed, StageMonitor& monitor) {
  const std::string name = "messages on " + input + " with a leading slash stripped";
  const auto counted = monitor.figures().find(name);
  const double before = counted == monitor.figures().end() ? 0.0 : counted->second;
  if (before == 0.0) {
    monitor.warned(InputError(
        "leading_slash", "frame '" + slashed + "' on " + input +
                             ": expected no leading slash (tf2); strips it from all messages on " +
                             input));
  }
  monitor.figure(name, before + 1.0);
}

}  // namespace datmo
