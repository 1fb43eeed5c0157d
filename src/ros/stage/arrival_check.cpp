// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/arrival_check.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <utility>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

/// Nobody publishes faster, Hz, or more at a time: a gap of more is another count, no loss.
constexpr double kMaxRate = 2000.0;
constexpr double kMaxBurst = 1000.0;

/// Publishers that are remembered: those with a new name at each start are many.
constexpr std::size_t kMaxPublishers = 20;

std::string waitedFor(double seconds, double max_wait) {
  char text[200];
  std::snprintf(text, sizeof text,
                "a message that waited for %.2f s, expected at most %.2f s: they come faster than "
                "they are served; goes on with newer ones",
                seconds, max_wait);
  return text;
}

}  // namespace

bool ArrivalCheck::passes(const Arrived& message, const ros::Time& now) {
  if (const std::uint32_t lost = lostBefore(message, now)) {
    const InputError error("lost_message",
                           std::to_string(lost) + " messages on " + topic_ + " from " +
                               message.publisher +
                               " did not come: a queue was full, as they come faster than they "
                               "are served, the network lost them, or a relay left them out");
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

std::uint32_t ArrivalCheck::lostBefore(const Arrived& message, const ros::Time& now) {
  if (last_.size() >= kMaxPublishers && last_.count(message.publisher) == 0) {
    last_.clear();
  }
  const auto [entry, is_first] = last_.try_emplace(message.publisher, Last{message.sequence, now});
  const Last last = std::exchange(entry->second, Last{message.sequence, now});
  if (is_first || message.sequence <= last.sequence) {
    return 0;
  }
  const std::uint32_t lost = message.sequence - last.sequence - 1;
  return lost <= kMaxBurst + kMaxRate * std::max(0.0, (now - last.at).toSec()) ? lost : 0;
}

}  // namespace datmo
