// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <rviz/properties/status_property.h>

namespace datmo {

/// A line of a display's status.
struct StatusLine {
  rviz::StatusProperty::Level level = rviz::StatusProperty::Ok;
  std::string text;
};

/// What the master says is published on a topic, if it is not `expected`; else, and without a
/// master, empty. Waits for one answer of the master, and tries no second time.
std::string otherType(const std::string& topic, const std::string& expected);

/// Whether somebody publishes what a display draws, and how much has come.
struct TopicStatus {
  std::string topic;
  std::string expected_type;
  std::uint32_t publishers = 0;  ///< that are connected
  std::uint32_t received = 0;    ///< messages

  /// Asks the master where nobody is connected.
  StatusLine line() const;
};

/// What became of a display's messages since the last reset.
class MessageStatus {
 public:
  /// A new one, which is not drawn yet.
  void addReceived();

  /// The newest one is drawn, but for `left_out` shapes with a number that is not finite.
  void setDrawn(std::size_t left_out);

  /// The newest one cannot be drawn; counted once, however often it is tried.
  void setRefused(const std::string& reason);

  /// Of the newest one.
  StatusLine newest() const { return newest_; }

  /// Of all: how many were refused, and why the last one.
  StatusLine refused() const;

 private:
  StatusLine newest_{rviz::StatusProperty::Warn, "no message to draw has come"};
  bool is_newest_refused_ = false;
  std::size_t received_ = 0;
  std::size_t refused_ = 0;
  std::string last_reason_;
};

}  // namespace datmo
