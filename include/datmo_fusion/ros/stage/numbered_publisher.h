// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include <boost/shared_ptr.hpp>

#include <ros/publisher.h>

#include "datmo_fusion/ros/stage/arrival_check.h"

namespace datmo {

/// Publishes numbered messages, so that a stage in the same process notices those that its queue
/// has lost.
class NumberedPublisher {
 public:
  NumberedPublisher() = default;
  explicit NumberedPublisher(ros::Publisher publisher) : publisher_(std::move(publisher)) {}

  template <typename Message>
  void publish(const boost::shared_ptr<Message>& message) {
    setSequence(*message, ++sequence_);
    publisher_.publish(message);
  }

  /// Full name; empty if nothing is advertised.
  std::string topic() const { return publisher_ ? publisher_.getTopic() : ""; }

 private:
  ros::Publisher publisher_;
  std::uint32_t sequence_ = 0;
};

}  // namespace datmo
