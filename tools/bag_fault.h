// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace datmo {

/// Returns why a file cannot be opened as a ROS 1 bag, and what to do about it; empty if nothing is
/// wrong. tools/datmo_tools/bag_input.py has the same messages.
std::string bagFault(const std::string& file);

}  // namespace datmo
