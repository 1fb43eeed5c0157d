// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/device_news.h"

#include <algorithm>
#include <utility>

namespace datmo {

namespace {

/// The oldest of its kind is left out where there are more; returns how many: none or one.
template <typename Kind>
std::uint64_t keepNewest(std::deque<DeviceNews>& news, std::size_t longest) {
  const auto is_such = [](const DeviceNews& one) { return std::holds_alternative<Kind>(one); };
  const auto count = std::count_if(news.begin(), news.end(), is_such);
  if (static_cast<std::size_t>(count) <= longest) {
    return 0;
  }
  news.erase(std::find_if(news.begin(), news.end(), is_such));
  return 1;
}

}  // namespace

void DeviceNewsQueue::put(DeviceNews news) {
  const std::lock_guard<std::mutex> lock(mutex_);
  news_.push_back(std::move(news));
  overtaken_ += keepNewest<DeviceMeasured>(news_, longest_);
  keepNewest<DeviceWarning>(news_, longest_);
}

DeviceNewsQueue::Taken DeviceNewsQueue::takeAll() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {std::exchange(news_, {}), overtaken_};
}

}  // namespace datmo
