// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <ros/duration.h>

#include "datmo_fusion/ros/stage/stage.h"

namespace datmo::campaign {

/// What can be done with the messages of a type that is known only by name.
struct MessageKind {
  /// As a bag and a subscription do it: bounded, and frame ids without leading slashes. Throws
  /// std::exception for bytes that are no message of this type.
  std::function<AnyMessage(std::vector<std::uint8_t> bytes)> decoded;

  std::function<std::vector<std::uint8_t>(const AnyMessage& message)> encoded;

  /// Returns a copy whose stamps are moved by `shift`.
  std::function<AnyMessage(const AnyMessage& message, ros::Duration shift)> shifted;

  /// Returns a copy with one to three of its fields corrupted.
  std::function<AnyMessage(const AnyMessage& message, std::mt19937& random)> mutated;
};

/// The types of all messages that stages read, and of those of the clocks of the stack's parts, by
/// name ("sensor_msgs/LaserScan").
const std::map<std::string, MessageKind>& messageKinds();

}  // namespace datmo::campaign
