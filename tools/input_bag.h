// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

namespace datmo {

/// Opens a bag for reading. Throws std::runtime_error that says what is wrong with which file, and
/// what to do: as bagFault(), or cut short, or without messages.
void openInput(const std::string& file, rosbag::Bag& bag);

/// The topics of a bag and their types, "topic (type)", sorted.
std::vector<std::string> topicsOf(const rosbag::Bag& bag);

bool holdsTopic(const rosbag::Bag& bag, const std::string& topic);

/// Throws std::runtime_error that names the file, says what is `missing` in it, and lists what it
/// holds.
[[noreturn]] void failForTopic(const rosbag::Bag& bag, const std::string& missing);

/// The message itself. Throws std::runtime_error that names topic and types if it is none of
/// `Message`.
template <typename Message>
boost::shared_ptr<Message> read(const rosbag::MessageInstance& message) {
  if (const auto content = message.instantiate<Message>()) {
    return content;
  }
  throw std::runtime_error(message.getTopic() + " is " + message.getDataType() + ", expected " +
                           ros::message_traits::datatype<Message>());
}

}  // namespace datmo
