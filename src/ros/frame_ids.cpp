// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/frame_ids.h"

namespace datmo {

std::string withoutSlash(const std::string& frame) {
  const std::size_t start = frame.find_first_not_of('/');
  return start == std::string::npos ? "" : frame.substr(start);
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
