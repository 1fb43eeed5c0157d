// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include "datmo_fusion/ros/bounded_stream.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

/// Opens a bag for reading. Throws std::runtime_error that names the file, what is wrong with it,
/// and what to do: as bagFault(), or if it is truncated or has no messages.
void openInput(const std::string& file, rosbag::Bag& bag);

/// The topics of a bag and their types, "topic (type)", sorted.
std::vector<std::string> topicsOf(const rosbag::Bag& bag);

bool holdsTopic(const rosbag::Bag& bag, const std::string& topic);

/// Whether it has messages of this type (`sensor_msgs/Imu`) on the topic, and no others.
bool holdsTopic(const rosbag::Bag& bag, const std::string& topic, const std::string& type);

/// Throws std::runtime_error that names the file and what is `missing` in it, and lists its topics.
[[noreturn]] void failForTopic(const rosbag::Bag& bag, const std::string& missing);

/// Returns the topic of an optional input, empty if the bag lacks it. `asked`: the user has named
/// it; then one of another type is returned, too, and read() refuses it. Throws like failForTopic
/// if the bag lacks a topic that was asked for.
template <typename Message>
std::string optionalTopic(const rosbag::Bag& bag, const std::string& topic, bool asked) {
  const std::string type = ros::message_traits::datatype<Message>();
  if (asked && !holdsTopic(bag, topic)) {
    failForTopic(bag, "no " + type + " on " + topic);
  }
  return asked || holdsTopic(bag, topic, type) ? topic : "";
}

/// The bytes of a message as recorded in the bag. Throws InputError as checkRecord().
std::vector<std::uint8_t> bytesOf(const rosbag::MessageInstance& message);

/// Throws InputError that names the topic of a message, and its type (`wrong_type`) or, if that is
/// the `expected` one, that it was recorded with another definition of it (`other_version`).
[[noreturn]] void failForType(const rosbag::MessageInstance& message, const std::string& expected);

/// Decodes the message. Throws InputError: as failForType() if it is not of type `Message`;
/// `undecodable_message`, with topic and time, if its bytes are corrupt.
template <typename Message>
boost::shared_ptr<Message> read(const rosbag::MessageInstance& message) {
  if (!message.isType<Message>()) {
    failForType(message, ros::message_traits::datatype<Message>());
  }
  try {
    return decodeBounded<Message>(bytesOf(message));
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw undecodable(
        message.getTopic() + " at " + std::to_string(message.getTime().toSec()) + " s",
        message.getDataType(), error.what());
  }
}

}  // namespace datmo
