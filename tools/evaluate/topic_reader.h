// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluate/recorded_messages.h"
#include "input_bag.h"

#include <ros/message_traits.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/Header.h>

#include "datmo_fusion/common/stamp.h"

namespace datmo::evaluation {

/// Reads the messages of one topic of an open bag. Its exceptions (std::runtime_error) name the
/// file, the topic and the stamp.
class TopicReader {
 public:
  TopicReader(const rosbag::Bag& bag, const std::string& topic) : bag_(bag), topic_(topic) {}

  bool isThere() const { return holdsTopic(bag_, topic_); }

  /// Calls `callback` with each message, in the order of their record times; exceptions of
  /// `callback` are rethrown with the location. Throws if there is no message, and after an
  /// interruption.
  template <typename Message, typename Callback>
  void forEach(const Callback& callback) {
    if (!isThere()) {
      failForTopic(bag_,
                   std::string("no ") + ros::message_traits::datatype<Message>() + " on " + topic_);
    }
    std::string location = topic_;
    try {
      rosbag::View view(bag_, rosbag::TopicQuery(topic_));
      for (const rosbag::MessageInstance& instance : view) {
        failIfInterrupted();
        location = topic_;
        const auto message = read<Message>(instance);
        location += " at " + std::to_string(message->header.stamp.toSec()) + " s";
        callback(*message);
      }
    } catch (const std::exception& error) {
      fail(location, error.what());
    }
  }

  /// All messages converted by toRecorded(), in order of stamp. Throws for a zero or repeated
  /// stamp, and for headers with different frames.
  template <typename Message>
  auto readAll() {
    std::vector<decltype(toRecorded(Message()))> recorded;
    forEach<Message>([&](const Message& message) {
      takeHeader(message.header);
      recorded.push_back(toRecorded(message));
    });
    std::stable_sort(recorded.begin(), recorded.end(),
                     [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
    for (std::size_t i = 1; i < recorded.size(); ++i) {
      checkOnce(recorded[i - 1].stamp, recorded[i].stamp);
    }
    return recorded;
  }

  /// The same; none if the topic does not exist.
  template <typename Message>
  auto readIfThere() {
    return isThere() ? std::make_optional(readAll<Message>()) : std::nullopt;
  }

  /// header.frame_id of the messages that readAll() has read.
  const std::string& frame() const { return frame_.value(); }

  const std::string& topic() const { return topic_; }

 private:
  [[noreturn]] void fail(const std::string& location, const std::string& what) const;
  void takeHeader(const std_msgs::Header& header);
  void checkOnce(Stamp before, Stamp stamp) const;
  void failIfInterrupted() const;

  const rosbag::Bag& bag_;
  std::string topic_;
  std::optional<std::string> frame_;
};

}  // namespace datmo::evaluation
