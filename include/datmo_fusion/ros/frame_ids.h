// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include <boost/make_shared.hpp>
#include <tf2_msgs/TFMessage.h>

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

/// Returns a frame's name without leading slash, which recordings from before tf2 have.
std::string withoutSlash(const std::string& frame);

/// The same as a part of `frame`, which must outlive it: not copied.
std::string_view plainName(std::string_view frame);

namespace detail {

/// Calls `visit` with each frame id of a message. This overload set is the only place that knows
/// which frames each message type has.
template <typename Message, typename Visit>
void visitFrames(Message& message, const Visit& visit) {
  visit(message.header.frame_id);
}

template <typename Visit>
void visitFrames(nav_msgs::Odometry& message, const Visit& visit) {
  visit(message.header.frame_id);
  visit(message.child_frame_id);
}

template <typename Visit>
void visitFrames(LabeledScanMessage& message, const Visit& visit) {
  visit(message.header.frame_id);
  visit(message.map_frame);
}

template <typename Visit>
void visitFrames(tf2_msgs::TFMessage& message, const Visit& visit) {
  for (geometry_msgs::TransformStamped& transform : message.transforms) {
    visit(transform.header.frame_id);
    visit(transform.child_frame_id);
  }
}

}  // namespace detail

/// Returns the first frame id of a message with a leading slash; empty if there is none.
template <typename Message>
std::string slashedFrame(const Message& message) {
  std::string found;
  // Only read, so const_cast is safe.
  detail::visitFrames(const_cast<Message&>(message), [&found](const std::string& frame) {
    if (found.empty() && frame.rfind('/', 0) == 0) {
      found = frame;
    }
  });
  return found;
}

/// Strips leading slashes from a message's frame ids.
template <typename Message>
void stripSlashes(Message& message) {
  detail::visitFrames(message, [](std::string& frame) { frame = withoutSlash(frame); });
}

/// Counts a message on `input` whose frame `slashed` had a leading slash, as a figure; warns once.
void noteSlash(const std::string& input, const std::string& slashed, StageMonitor& monitor);

/// Returns the message itself, or a copy without leading slashes in its frame ids, which is
/// reported to the monitor. `input`: its topic.
template <typename Message>
boost::shared_ptr<const Message> withPlainFrames(const std::string& input,
                                                 const boost::shared_ptr<const Message>& message,
                                                 StageMonitor& monitor) {
  const std::string slashed = slashedFrame(*message);
  if (slashed.empty()) {
    return message;
  }
  noteSlash(input, slashed, monitor);
  const auto stripped = boost::make_shared<Message>(*message);
  stripSlashes(*stripped);
  return stripped;
}

/// Entry point of a nodelet: records a message's arrival, and returns it with plain frames.
template <typename Message>
boost::shared_ptr<const Message> receive(const std::string& input,
                                         const boost::shared_ptr<const Message>& message,
                                         StageMonitor& monitor) {
  monitor.received(input, toStamp(ros::Time::now()));
  return withPlainFrames(input, message, monitor);
}

}  // namespace datmo
