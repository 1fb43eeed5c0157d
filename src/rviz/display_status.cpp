// SPDX-License-Identifier: BSD-3-Clause
#include "display_status.h"

#include <ros/master.h>
#include <ros/this_node.h>

namespace datmo {

using rviz::StatusProperty;

std::string otherType(const std::string& topic, const std::string& expected) {
  XmlRpc::XmlRpcValue request;
  request[0] = ros::this_node::getName();
  request[1] = "";
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue topics;
  constexpr bool kWaitForMaster = false;  // no retries: the window waits for the response
  if (!ros::master::execute("getPublishedTopics", request, response, topics, kWaitForMaster)) {
    return "";
  }
  for (int i = 0; i < topics.size(); ++i) {
    const std::string name = topics[i][0];
    const std::string type = topics[i][1];
    if (name == topic && type != expected && type != "*") {
      return type;
    }
  }
  return "";
}

StatusLine TopicStatus::line() const {
  // rviz counts what its transform filter lets pass.
  const std::string count = received > 0 ? std::to_string(received) + " messages received"
                                         : "no message with a transform received";
  if (publishers > 0) {
    return {StatusProperty::Ok, count};
  }
  const std::string other = otherType(topic, expected_type);
  if (!other.empty()) {
    return {StatusProperty::Error, topic + " is " + other + ": expected " + expected_type};
  }
  return {StatusProperty::Warn, "no publisher of " + topic + "; " + count};
}

void MessageStatus::addReceived() {
  ++received_;
  is_newest_refused_ = false;
  newest_ = {StatusProperty::Warn, "not drawn: see Transform"};
}

void MessageStatus::setDrawn(std::size_t left_out) {
  newest_ = {StatusProperty::Ok, "OK"};
  if (left_out > 0) {
    newest_ = {
        StatusProperty::Warn,
        std::to_string(left_out) + " shapes are not drawn: they have numbers that are not finite"};
  }
}

void MessageStatus::setRefused(const std::string& reason) {
  refused_ += is_newest_refused_ ? 0 : 1;
  is_newest_refused_ = true;
  last_reason_ = reason;
  newest_ = {StatusProperty::Error, reason};
}

StatusLine MessageStatus::refused() const {
  if (refused_ == 0) {
    return {StatusProperty::Ok, "none"};
  }
  return {StatusProperty::Warn, std::to_string(refused_) + " of " + std::to_string(received_) +
                                    " messages, the last one: " + last_reason_};
}

}  // namespace datmo
