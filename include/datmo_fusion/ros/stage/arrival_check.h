// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <ros/message_event.h>
#include <ros/message_traits.h>
#include <ros/time.h>
#include <std_msgs/Header.h>

#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Arrival of a message: its publisher, its sequence number there, and when (ROS time) it was put
/// into the queue of its stage.
struct Arrived {
  std::string publisher;
  std::uint32_t sequence = 0;  ///< of its header; 0: not numbered by the publisher
  ros::Time queued;            ///< zero: unknown
};

/// Makes losses between a publisher and a stage visible, and keeps the stage's input recent if it
/// cannot keep up: counts the messages of one topic lost in queues or the network, by ROS's
/// sequence numbers, and drops those that have waited too long.
class ArrivalCheck {
 public:
  /// `max_wait`: s; `monitor` must outlive it.
  ArrivalCheck(std::string topic, double max_wait, StageMonitor& monitor)
      : topic_(std::move(topic)), max_wait_(max_wait), monitor_(monitor) {}

  /// Whether to process a message. Reports losses before it (`lost_message`) to the monitor, and
  /// drops it if it is too old (`stale_message`).
  bool passes(const Arrived& message, const ros::Time& now);

  /// Notes a message that has arrived but could not be decoded: it is not lost. `sequence` may be
  /// ahead of the messages that still wait for passes(); 0: unknown, and then it counts as lost.
  void noteUndecodable(const std::string& publisher, std::uint32_t sequence);

 private:
  /// What is known of the messages of a publisher, by their sequence numbers.
  struct Publisher {
    std::optional<std::uint32_t> last;    ///< none before the first one
    std::set<std::uint32_t> undecodable;  ///< after the last one
  };

  Publisher& publisherOf(const std::string& name);

  /// Number of messages lost before this one of the same publisher.
  std::uint32_t lostBefore(const Arrived& message);

  std::string topic_;
  double max_wait_;
  StageMonitor& monitor_;
  std::map<std::string, Publisher> publishers_;  ///< by name
};

/// Returns the sequence number of a message; 0 without a header.
template <typename Message>
std::uint32_t sequenceOf(const Message& message) {
  const std_msgs::Header* const header = ros::message_traits::header(message);
  return header == nullptr ? 0 : header->seq;
}

/// Numbers a message, which ROS does only when it serializes it to a connection, not for a nodelet
/// of the same process.
template <typename Message>
void setSequence(Message& message, std::uint32_t sequence) {
  if (std_msgs::Header* const header = ros::message_traits::header(message)) {
    header->seq = sequence;
  }
}

/// In simulated time the queueing time is unknown: that clock runs as fast as a bag is played.
template <typename Message>
Arrived arrivedOf(const ros::MessageEvent<const Message>& event) {
  return {event.getPublisherName(), sequenceOf(*event.getConstMessage()),
          ros::Time::isSimTime() ? ros::Time() : event.getReceiptTime()};
}

}  // namespace datmo
