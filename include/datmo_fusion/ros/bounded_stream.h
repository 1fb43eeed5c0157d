// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <boost/make_shared.hpp>

#include <ros/serialization.h>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

/// The bytes of one message, to be decoded by ros::serialization. Its own IStream allocates memory
/// for as many elements as a corrupt length field states, up to 2^32, before it detects that they
/// are missing.
class BoundedStream : public ros::serialization::Stream {
 public:
  static constexpr ros::serialization::StreamType stream_type =
      ros::serialization::stream_types::Input;

  BoundedStream(std::uint8_t* data, std::uint32_t size) : Stream(data, size) {}

  template <typename Value>
  void next(Value& value) {
    ros::serialization::deserialize(*this, value);
  }

  /// Throws std::runtime_error if more elements are announced than the bytes that are left can
  /// hold.
  template <typename Element, typename Allocator>
  void next(std::vector<Element, Allocator>& elements) {
    ros::serialization::Stream peek = *this;
    std::uint32_t count = 0;
    const std::uint32_t size = sizeof(count);
    ros::serialization::IStream length(peek.advance(size), size);
    length.next(count);
    static const std::uint32_t min_size =
        std::max(1U, ros::serialization::serializationLength(Element()));
    if (count > peek.getLength() / min_size) {
      throw std::runtime_error("an array of " + std::to_string(count) + " elements, but only " +
                               std::to_string(peek.getLength()) + " bytes are left");
    }
    ros::serialization::deserialize(*this, elements);
  }
};

/// Decodes a message. Throws std::exception if its bytes are corrupt.
template <typename Message>
boost::shared_ptr<Message> decodeBounded(std::vector<std::uint8_t> bytes) {
  BoundedStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  const auto message = boost::make_shared<Message>();
  stream.next(*message);
  return message;
}

/// The error for a message whose bytes are corrupt (`undecodable_message`). `where`: its topic, and
/// what else identifies it; `why`: what the stream has thrown.
inline InputError undecodable(const std::string& where, const std::string& data_type,
                              const std::string& why) {
  return {"undecodable_message",
          where + ": expected a complete " + data_type + " (" + why + "); skips it"};
}

}  // namespace datmo
