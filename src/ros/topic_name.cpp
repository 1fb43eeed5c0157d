// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/topic_name.h"

#include <regex>

namespace datmo {

bool canBeTopic(const std::string& name) {
  static const std::regex kTopic("[A-Za-z][A-Za-z0-9_]*");
  return std::regex_match(name, kTopic);
}

}  // namespace datmo
