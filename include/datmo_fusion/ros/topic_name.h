// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace datmo {

/// Whether a user-defined name can be the last part of a topic: letters, digits and underscores,
/// starting with a letter (ROS graph resource names).
bool canBeTopic(const std::string& name);

}  // namespace datmo
