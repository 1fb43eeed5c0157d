// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stage_monitor.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <ros/console.h>

#include "datmo_fusion/common/quantile.h"

namespace datmo {

namespace {

/// Number of messages for a rate: a few seconds of a scanner.
constexpr std::size_t kRateWindow = 50;

/// Number of messages for processing times, so that a 99th percentile is meaningful.
constexpr std::size_t kTimingWindow = 1000;

template <typename Value>
void pushBounded(std::deque<Value>& values, const Value& value, std::size_t max) {
  values.push_back(value);
  if (values.size() > max) {
    values.pop_front();
  }
}

std::uint64_t total(const std::map<std::string, std::uint64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& count) { return sum + count.second; });
}

}  // namespace

StageMonitor::StageMonitor(const std::string& stage)
    : stage_(stage.substr(stage.find_first_not_of('/'))) {}

void StageMonitor::received(const std::string& input, Stamp now) {
  setTime(now);
  Input& entry = inputs_[input];
  ++entry.count;
  if (!entry.arrivals.empty() && now < entry.arrivals.back()) {
    entry.arrivals.clear();  // the clock was set back
  }
  pushBounded(entry.arrivals, now, kRateWindow);
}

void StageMonitor::processed(const Processed& message) {
  ++processed_;
  last_processed_ = message;
  last_result_ = now_;
  pushBounded(times_, message.seconds, kTimingWindow);
}

void StageMonitor::dropped(const InputError& error, std::uint64_t count) {
  drops_[error.reason()] += count;
  last_drop_ = error.what();
  say(error, count);
}

void StageMonitor::condition(HealthLevel health, const std::string& why) {
  if (why != health_reason_ && health == HealthLevel::kOk) {
    ROS_INFO("%s: %s", stage_.c_str(), why.c_str());
  } else if (why != health_reason_) {
    ROS_WARN("%s: %s", stage_.c_str(), why.c_str());
  }
  health_ = health;
  health_reason_ = why;
}

void StageMonitor::warned(const InputError& error) {
  ++warnings_[error.reason()];
  last_warning_ = error.what();
  say(error);
}

void StageMonitor::say(const InputError& error, std::uint64_t count) {
  last_error_ = error.what();
  const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
  if (const auto line = repeats_.lineOf(error, now.count(), count)) {
    ROS_WARN("%s: %s", stage_.c_str(), line->c_str());
  }
}

void StageMonitor::describe(const std::string& input,
                            const std::function<std::string()>& description) {
  if (descriptions_.count(input) == 0) {
    descriptions_[input] = description();
  }
}

std::string StageMonitor::description(const std::string& input) const {
  const auto found = descriptions_.find(input);
  return found == descriptions_.end() ? "" : found->second;
}

void StageMonitor::announce(const std::string& event, const std::string& text) {
  if (events_.insert(event).second) {
    announcements_.push_back(text);
  }
}

std::vector<std::string> StageMonitor::handleAnnouncements() {
  return std::exchange(announcements_, {});
}

InputStatus StageMonitor::input(const std::string& name, Stamp now) const {
  InputStatus status;
  const auto found = inputs_.find(name);
  if (found == inputs_.end()) {
    return status;
  }
  const auto& arrivals = found->second.arrivals;
  status.received = found->second.count;
  status.silence = std::max(0.0, secondsBetween(arrivals.back(), now));
  const double span = secondsBetween(arrivals.front(), arrivals.back());
  status.rate = span > 0.0 ? static_cast<double>(arrivals.size() - 1) / span : 0.0;
  return status;
}

TimingStatus StageMonitor::timing() const {
  const std::vector<double> times(times_.begin(), times_.end());
  return {quantile(times, 0.5), quantile(times, 0.99), quantile(times, 1.0)};
}

std::uint64_t StageMonitor::droppedCount() const { return total(drops_); }

std::uint64_t StageMonitor::warningCount() const { return total(warnings_); }

}  // namespace datmo
