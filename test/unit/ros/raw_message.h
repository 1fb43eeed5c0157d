// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include <ros/message_traits.h>
#include <ros/serialization.h>

namespace datmo {

/// Bytes that are written to a bag or published as a `Message`, whether they are a valid one or
/// not.
template <typename Message>
struct RawMessage {
  std::vector<std::uint8_t> bytes;
};

template <typename Message>
RawMessage<Message> toRaw(const Message& message) {
  RawMessage<Message> raw;
  raw.bytes.resize(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(raw.bytes.data(),
                                     static_cast<std::uint32_t>(raw.bytes.size()));
  ros::serialization::serialize(stream, message);
  return raw;
}

}  // namespace datmo

namespace ros::message_traits {

template <typename Message>
struct MD5Sum<datmo::RawMessage<Message>> {
  static const char* value() { return MD5Sum<Message>::value(); }
  static const char* value(const datmo::RawMessage<Message>& /*raw*/) { return value(); }
};

template <typename Message>
struct DataType<datmo::RawMessage<Message>> {
  static const char* value() { return DataType<Message>::value(); }
  static const char* value(const datmo::RawMessage<Message>& /*raw*/) { return value(); }
};

template <typename Message>
struct Definition<datmo::RawMessage<Message>> {
  static const char* value() { return Definition<Message>::value(); }
  static const char* value(const datmo::RawMessage<Message>& /*raw*/) { return value(); }
};

}  // namespace ros::message_traits

namespace ros::serialization {

template <typename Message>
struct Serializer<datmo::RawMessage<Message>> {
  template <typename Stream>
  static void write(Stream& stream, const datmo::RawMessage<Message>& raw) {
    const auto size = static_cast<std::uint32_t>(raw.bytes.size());
    std::memcpy(stream.advance(size), raw.bytes.data(), size);
  }
  static std::uint32_t serializedLength(const datmo::RawMessage<Message>& raw) {
    return static_cast<std::uint32_t>(raw.bytes.size());
  }
};

}  // namespace ros::serialization
