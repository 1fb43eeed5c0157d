// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace datmo {

/// The first line of a bag of format 2.0, the only one that is read: for others rosbag has code
/// that believes any length in a file.
constexpr std::string_view kBagVersion = "#ROSBAG V2.0\n";

/// Returns why a file cannot be opened as a ROS 1 bag, and what to do about it; empty if nothing is
/// wrong. tools/datmo_tools/bag_input.py has the same messages.
std::string bagFault(const std::string& file);

}  // namespace datmo
