// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/arrival_check.h"

#include <cstddef>
#include <cstdio>
#include <iterator>
#include <utility>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

/// A larger gap is a new numbering rather than a loss: a stage that stood still for an hour has
/// missed 720,000 messages of odometry at 200 Hz. The time between two messages is not informative:
/// after a standstill the last ones before it, from the connection's buffer, are received together
/// with those after it.
constexpr std::uint32_t kMaxGap = 1000000;

/// Maximum number of remembered publishers: some have a new name at each start.
constexpr std::size_t kMaxPublishers = 20;

/// Maximum number of remembered undecodable messages per publisher: there may be no others.
constexpr std::size_t kMaxUndecodable = 1000;

std::string waitedFor(double seconds, double max_wait) {
  char text[200];
  std::snprintf(text, sizeof text,
                "a message waited for %.2f s, expected at most %.2f s: they arrive faster than "
                "they are processed; continues with newer ones",
                seconds, max_wait);
  return text;
}

}  // namespace

bool ArrivalCheck::passes(const Arrived& message, const ros::Time& now) {
  if (const std::uint32_t lost = lostBefore(message)) {
    const InputError error("lost_message",
                           std::to_string(lost) + " messages on " + topic_ + " from " +
                               message.publisher +
                               " were lost: a queue was full because they arrive faster than they "
                               "are processed, the network lost them, or a relay skipped them");
    monitor_.dropped(error, lost);
    const std::string figure = "lost on " + topic_;
    const auto before = monitor_.figures().find(figure);
    monitor_.figure(figure, lost + (before == monitor_.figures().end() ? 0.0 : before->second));
  }
  if (message.queued.isZero() || (now - message.queued).toSec() <= max_wait_) {
    return true;
  }
  monitor_.dropped(InputError(
      "stale_message", topic_ + ": " + waitedFor((now - message.queued).toSec(), max_wait_)));
  return false;
}

void ArrivalCheck::noteUndecodable(const std::string& publisher, std::uint32_t sequence) {
  std::set<std::uint32_t>& undecodable = publisherOf(publisher).undecodable;
  undecodable.insert(sequence);
  if (undecodable.size() > kMaxUndecodable) {
    undecodable.erase(undecodable.begin());
  }
}

ArrivalCheck::Publisher& ArrivalCheck::publisherOf(const std::string& name) {
  if (publishers_.size() >= kMaxPublishers && publishers_.count(name) == 0) {
    publishers_.clear();
  }
  return publishers_[name];
}

std::uint32_t ArrivalCheck::lostBefore(const Arrived& message) {
  Publisher& publisher = publisherOf(message.publisher);
  const std::uint32_t last = publisher.last.value_or(message.sequence);
  publisher.last = message.sequence;
  std::set<std::uint32_t>& noted = publisher.undecodable;
  const auto end = noted.lower_bound(message.sequence);
  const bool goes_on = message.sequence > last && message.sequence - last <= kMaxGap;
  const auto undecodable = goes_on ? std::distance(noted.upper_bound(last), end) : 0;
  noted.erase(noted.begin(), end);
  return goes_on ? message.sequence - last - 1 - static_cast<std::uint32_t>(undecodable) : 0;
}

}  // namespace datmo
