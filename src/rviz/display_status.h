// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <rviz/properties/status_property.h>

namespace datmo {

/// A line in a display's status.
struct StatusLine {
  rviz::StatusProperty::Level level = rviz::StatusProperty::Ok;
  std::string text;
};

/// Returns the type that the master last reported for a topic, if it is not `expected`; otherwise,
/// and if the master has not answered yet, empty. Queries the master again, without waiting for it:
/// call it from time to time, in the window's thread.
std::string otherType(const std::string& topic, const std::string& expected);

/// Whether what a display draws is published, and how many messages were received.
struct TopicStatus {
  std::string topic;
  std::string expected_type;
  std::uint32_t publishers = 0;  ///< connected
  std::uint32_t received = 0;    ///< messages

  /// Queries the master if no publisher is connected.
  StatusLine line() const;
};

/// Status of a display's messages since the last reset.
class MessageStatus {
 public:
  /// Reports a new message, which is not drawn yet.
  void addReceived();

  /// Reports that the newest message was drawn, except for `left_out` shapes with non-finite
  /// numbers.
  void setDrawn(std::size_t left_out);

  /// Reports that the newest message cannot be drawn; counted once, however often it is tried.
  void setRefused(const std::string& reason);

  /// Status of the newest message.
  StatusLine newest() const { return newest_; }

  /// Status of all messages: number of rejected ones, and the reason for the last.
  StatusLine refused() const;

 private:
  StatusLine newest_{rviz::StatusProperty::Warn, "no message to draw received"};
  bool is_newest_refused_ = false;
  std::size_t received_ = 0;
  std::size_t refused_ = 0;
  std::string last_reason_;
};

}  // namespace datmo
