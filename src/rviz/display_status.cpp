// SPDX-License-Identifier: BSD-3-Clause
#include "display_status.h"

#include <chrono>

#include "datmo_fusion/ros/stage/published_topics.h"

namespace datmo {

using rviz::StatusProperty;

namespace {

/// The window does not wait for the master: it shows the answer the next time that it asks.
constexpr std::chrono::milliseconds kNoPatience(0);

constexpr char kAnyType[] = "*";  // of a publisher that has not said its type

/// Of all displays and panels, which run in the window's thread.
PublishedTopics& publishedTopics() {
  static PublishedTopics topics;
  return topics;
}

}  // namespace

std::string otherType(const std::string& topic, const std::string& expected) {
  publishedTopics().update(kNoPatience);
  const std::string type = publishedTopics().typeOf(topic).value_or("");
  return type == expected || type == kAnyType ? "" : type;
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
