// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include <ros/message_event.h>
#include <ros/message_traits.h>
#include <ros/time.h>
#include <std_msgs/Header.h>

#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// How a message came: who sent it, which one of theirs it is, and when (ROS time) it was put into
/// the queue of its stage.
struct Arrived {
  std::string publisher;
  std::uint32_t sequence = 0;  ///< of its header; 0: the publisher does not count
  ros::Time queued;            ///< zero: not known
};

/// Nothing is lost silently between a publisher and a stage, and where a stage cannot keep up, what
/// it serves is new: counts the messages of one topic that queues or the network have lost, by the
/// numbers that ROS gives them, and drops those that have waited for too long.
class ArrivalCheck {
 public:
  /// `max_wait`: s; `monitor` must outlive it.
  ArrivalCheck(std::string topic, double max_wait, StageMonitor& monitor)
      : topic_(std::move(topic)), max_wait_(max_wait), monitor_(monitor) {}

  /// Whether a message is to be served. Drops through the monitor what was lost before it
  /// (`lost_message`), and itself if it is too old (`stale_message`).
  bool passes(const Arrived& message, const ros::Time& now);

 private:
  /// How many were lost before this one of its publisher.
  std::uint32_t lostBefore(const Arrived& message);

  std::string topic_;
  double max_wait_;
  StageMonitor& monitor_;
  std::map<std::string, std::uint32_t> last_;  ///< number by publisher
};

/// The number of a message in the order of its publisher; 0 where it has no header.
template <typename Message>
std::uint32_t sequenceOf(const Message& message) {
  const std_msgs::Header* const header = ros::message_traits::header(message);
  return header == nullptr ? 0 : header->seq;
}

/// Numbers a message as ROS does where it writes it to a connection; to another nodelet of the
/// process it goes as it is.
template <typename Message>
void setSequence(Message& message, std::uint32_t sequence) {
  if (std_msgs::Header* const header = ros::message_traits::header(message)) {
    header->seq = sequence;
  }
}

/// In simulated time, when it was queued is not known: that clock goes as fast as a bag is played.
template <typename Message>
Arrived arrivedOf(const ros::MessageEvent<const Message>& event) {
  return {event.getPublisherName(), sequenceOf(*event.getConstMessage()),
          ros::Time::isSimTime() ? ros::Time() : event.getReceiptTime()};
}

}  // namespace datmo
