// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace datmo {

/// Whether a name that somebody has set can be the last part of a topic: letters, digits and
/// underscores, a letter first (ROS graph resource names).
bool canBeTopic(const std::string& name);

}  // namespace datmo
