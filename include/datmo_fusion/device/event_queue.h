// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <utility>
#include <variant>

namespace datmo {

/// Queue of events from one thread to another. If they are not taken, newer events of the `Bounded`
/// kinds replace older ones of their kind; those of other kinds are rare, and kept. Thread safe.
/// `Event`: a std::variant; discarded events of the first `Bounded` kind are counted.
template <typename Event, typename First, typename... Bounded>
class EventQueue {
 public:
  /// `max_waiting`: maximum number of waiting events of each bounded kind.
  explicit EventQueue(std::size_t max_waiting) : max_waiting_(max_waiting) {}

  void put(Event event) {
    const std::lock_guard<std::mutex> lock(mutex_);
    events_.push_back(std::move(event));
    discarded_ += keepNewest<First>();
    (keepNewest<Bounded>(), ...);
  }

  struct Taken {
    std::deque<Event> events;     ///< in order
    std::uint64_t discarded = 0;  ///< of the first bounded kind, in total
  };
  /// Returns all waiting events.
  Taken takeAll() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return {std::exchange(events_, {}), discarded_};
  }

 private:
  /// Removes the oldest of its kind if there are more; returns how many were removed: 0 or 1.
  template <typename Kind>
  std::uint64_t keepNewest() {
    if (events_.size() <= max_waiting_) {
      return 0;
    }
    const auto is_such = [](const Event& one) { return std::holds_alternative<Kind>(one); };
    const auto count = std::count_if(events_.begin(), events_.end(), is_such);
    if (static_cast<std::size_t>(count) <= max_waiting_) {
      return 0;
    }
    events_.erase(std::find_if(events_.begin(), events_.end(), is_such));
    return 1;
  }

  std::size_t max_waiting_;
  std::mutex mutex_;
  std::deque<Event> events_;
  std::uint64_t discarded_ = 0;
};

}  // namespace datmo
