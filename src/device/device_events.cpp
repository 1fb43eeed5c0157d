// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/device_events.h"

#include <algorithm>
#include <utility>

namespace datmo {

namespace {

/// Removes the oldest of its kind if there are more; returns how many were removed: 0 or 1.
template <typename Kind>
std::uint64_t keepNewest(std::deque<DeviceEvent>& events, std::size_t longest) {
  const auto is_such = [](const DeviceEvent& one) { return std::holds_alternative<Kind>(one); };
  const auto count = std::count_if(events.begin(), events.end(), is_such);
  if (static_cast<std::size_t>(count) <= longest) {
    return 0;
  }
  events.erase(std::find_if(events.begin(), events.end(), is_such));
  return 1;
}

}  // namespace

void DeviceEventQueue::put(DeviceEvent event) {
  const std::lock_guard<std::mutex> lock(mutex_);
  events_.push_back(std::move(event));
  discarded_ += keepNewest<DeviceMeasured>(events_, longest_);
  keepNewest<DeviceWarning>(events_, longest_);
}

DeviceEventQueue::Taken DeviceEventQueue::takeAll() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {std::exchange(events_, {}), discarded_};
}

}  // namespace datmo
