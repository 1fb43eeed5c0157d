// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include <sensor_msgs/Image.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

/// Holds the newest image until another sensor's measurement at its exposure is received.
///
/// It waits until there is a measurement at its time, until the measurements are newer, or until
/// its maximum waiting time.
template <typename Measurement>
class ImageWait {
 public:
  /// `tolerance` (s): between exposure and measurement. `max_wait` (s): maximum waiting time.
  ImageWait(double tolerance, double max_wait) : tolerance_(tolerance), max_wait_(max_wait) {}

  /// Stamps must rise.
  void addMeasurement(Stamp stamp, Measurement measurement) {
    measurements_.emplace_back(stamp, std::move(measurement));
    if (measurements_.size() > kMaxMeasurements) {
      measurements_.pop_front();
    }
  }

  /// Returns false if it replaces an earlier image that was still waiting. `now`: ROS time.
  bool addImage(const sensor_msgs::ImageConstPtr& image, Stamp now) {
    return !std::exchange(waiting_, Waiting{image, now}).has_value();
  }

  /// Returns the image if it need not wait any longer; else null. `now`: ROS time.
  sensor_msgs::ImageConstPtr next(Stamp now) {
    if (!waiting_) {
      return nullptr;
    }
    const Stamp exposure = toStamp(waiting_->image->header.stamp);
    const double waited = secondsBetween(waiting_->since, now);
    const bool may_wait = waited >= 0.0 && waited < max_wait_;
    const bool has_newer = !measurements_.empty() && measurements_.back().first >= exposure;
    if (may_wait && !has_newer && nearest(exposure) == nullptr) {
      return nullptr;
    }
    return std::exchange(waiting_, std::nullopt)->image;
  }

  /// Returns the measurement nearest to this exposure; null if none is within the tolerance.
  const Measurement* nearest(Stamp exposure) const {
    const Measurement* nearest = nullptr;
    double min_interval = tolerance_;
    for (const auto& [stamp, measurement] : measurements_) {
      const double interval = std::abs(secondsBetween(stamp, exposure));
      if (interval <= min_interval) {
        nearest = &measurement;
        min_interval = interval;
      }
    }
    return nearest;
  }

  /// Stamp of the newest measurement; none without any.
  std::optional<Stamp> newestStamp() const {
    return measurements_.empty() ? std::nullopt : std::optional(measurements_.back().first);
  }

  void clear() {
    measurements_.clear();
    waiting_.reset();
  }

 private:
  struct Waiting {
    sensor_msgs::ImageConstPtr image;
    Stamp since;
  };

  /// One second of a fast scanner: longer than an image may wait.
  static constexpr std::size_t kMaxMeasurements = 64;

  double tolerance_;
  double max_wait_;
  std::deque<std::pair<Stamp, Measurement>> measurements_;
  std::optional<Waiting> waiting_;
};

}  // namespace datmo
