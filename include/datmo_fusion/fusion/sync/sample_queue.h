// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/waiting_bound.h"

namespace datmo {

/// The samples of one source that may still be used in a set, by rising stamp. Bounded: the oldest
/// is dropped first.
template <typename Payload>
class SampleQueue {
 public:
  struct Sample {
    Stamp stamp;
    std::shared_ptr<const Payload> payload;
    bool served = false;
  };

  /// `late_by`: s, allowed lateness; 0: sets wait for this source.
  void setLateBy(double late_by) { late_by_ = late_by; }
  double lateBy() const { return late_by_; }

  /// Stamp of the last sample since samples were forgotten, even if that sample is gone.
  std::optional<Stamp> last() const { return last_; }

  /// Number of samples that were never used in a set and never will be.
  std::uint64_t unserved() const { return unserved_; }

  /// Adds a sample; returns false and ignores it if it is not newer than the last.
  bool add(Stamp stamp, std::shared_ptr<const Payload> payload) {
    if (last_ && stamp <= *last_) {
      return false;
    }
    last_ = stamp;
    samples_.push_back({stamp, std::move(payload)});
    if (samples_.size() > kMaxWaitingSamples) {
      dropOldest();
    }
    return true;
  }

  /// Returns the oldest sample after a stamp (or of all, without one); null if there is none.
  /// `unserved_only`: considers only samples that were in no set.
  Sample* firstAfter(std::optional<Stamp> stamp, bool unserved_only) {
    return find([&](const Sample& sample) {
      return (!stamp || *stamp < sample.stamp) && !(unserved_only && sample.served);
    });
  }

  /// Returns the sample nearest in time, the earlier one of two equally near, ignoring those that
  /// are nearer to `next`. Null if there is none.
  Sample* nearest(Stamp stamp, std::optional<Stamp> next) {
    const auto distance = [](Stamp at, const Sample& sample) {
      return std::abs(secondsBetween(at, sample.stamp));
    };
    auto end = samples_.end();
    if (next) {
      end = std::find_if(samples_.begin(), end, [&](const Sample& sample) {
        return distance(*next, sample) < distance(stamp, sample);
      });
    }
    const auto found = std::min_element(
        samples_.begin(), end,
        [&](const Sample& a, const Sample& b) { return distance(stamp, a) < distance(stamp, b); });
    return found == end ? nullptr : &*found;
  }

  /// Drops the oldest ones as long as `isPast(stamp)`.
  template <typename Predicate>
  void dropWhile(const Predicate& isPast) {
    while (!samples_.empty() && isPast(samples_.front().stamp)) {
      dropOldest();
    }
  }

  /// Drops all up to the last one that was used: older ones would be a step back in time.
  void dropUpToServed() {
    while (find([](const Sample& sample) { return sample.served; }) != nullptr) {
      dropOldest();
    }
  }

  /// Resets as if the source had never published, but keeps the count of unserved samples.
  void forget() {
    dropWhile([](Stamp) { return true; });
    last_.reset();
  }

 private:
  template <typename Predicate>
  Sample* find(const Predicate& predicate) {
    const auto found = std::find_if(samples_.begin(), samples_.end(), predicate);
    return found == samples_.end() ? nullptr : &*found;
  }

  void dropOldest() {
    unserved_ += samples_.front().served ? 0 : 1;
    samples_.pop_front();
  }

  std::deque<Sample> samples_;
  std::optional<Stamp> last_;
  std::uint64_t unserved_ = 0;
  double late_by_ = 0.0;
};

}  // namespace datmo
