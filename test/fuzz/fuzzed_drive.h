// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace datmo::fuzz {

/// A topic of a graph of stages, and the type of its messages.
struct TypedTopic {
  std::string name;
  std::string data_type;

  bool operator==(const TypedTopic& other) const {
    return name == other.name && data_type == other.data_type;
  }
};

/// A serialized message, which need not be a valid one.
struct TimedMessage {
  std::uint8_t topic = 0;  ///< index; modulo their number
  std::uint16_t wait = 0;  ///< ms, since the message before
  std::vector<std::uint8_t> bytes;
};

/// A sequence of messages for one of the campaign's graphs: the input of scripts/fuzz stages.
struct FuzzedDrive {
  std::uint8_t graph = 0;  ///< index; modulo their number
  std::vector<TypedTopic> topics;
  std::vector<TimedMessage> messages;

  /// The topic of a message; there must be topics.
  const TypedTopic& topicOf(const TimedMessage& message) const {
    return topics[message.topic % topics.size()];
  }
};

/// Returns the index of a topic, which is added if it is new; any other one if there are too many.
std::uint8_t topicIndexIn(FuzzedDrive& drive, const TypedTopic& topic);

/// Reads what encode() has written. Never fails: bytes that are missing are zero, and a message
/// that ends early is shorter. Without topics, there are no messages.
FuzzedDrive decodeDrive(std::string_view bytes);

std::string encode(const FuzzedDrive& drive);

/// Returns by how many bytes encode() returns more with this message.
std::size_t encodedSize(const TimedMessage& message);

}  // namespace datmo::fuzz
