// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace datmo {

/// What is wrong with a file before it is opened as a bag of ROS 1, and what to do about it; empty:
/// nothing. tools/datmo_tools/bag_input.py says the same in the same words.
std::string bagFault(const std::string& file);

}  // namespace datmo
