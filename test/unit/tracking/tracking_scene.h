// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/tracking/tracker.h"

namespace datmo {

/// An object as a scanner would report it: a box of a cyclist's size at (x, y) in m.
inline Object objectAt(double x, double y, DynamicState state = DynamicState::kUnknown) {
  Object object;
  object.box = {Pose2(x, y, 0.0), 1.7, 0.6};
  object.position_covariance = Eigen::Matrix2d::Identity() * 0.04;
  object.heading_variance = 0.1;
  object.dynamic_state = state;
  object.moving_fraction = state == DynamicState::kMoving ? 1.0 : 0.0;
  object.sensors = {"lidar"};
  return object;
}

inline std::set<std::uint32_t> idsOf(const TrackList& list) {
  std::set<std::uint32_t> ids;
  for (const Track& track : list.tracks) {
    ids.insert(track.id);
  }
  return ids;
}

/// Passes scans at a fixed rate to a tracker; the vehicle is stationary at the origin unless set
/// otherwise.
class TrackingScene {
 public:
  explicit TrackingScene(const TrackerOptions& options = TrackerOptions(), double period = 0.1,
                         StepClock clock = {})
      : tracker_(options, std::move(clock)), period_(period) {}

  const TrackList& scan(const std::vector<Object>& objects, const Pose2& base_in_fixed = Pose2()) {
    time_ += period_;
    tracks_ = tracker_.process({Stamp::fromSeconds(time_), objects, {}}, base_in_fixed);
    return tracks_;
  }

  /// The same with the visibility from the origin.
  const TrackList& scan(const std::vector<Object>& objects, const Visibility& visibility) {
    time_ += period_;
    tracks_ = tracker_.process({Stamp::fromSeconds(time_), objects, {}}, Pose2(), visibility);
    return tracks_;
  }

  /// s; of the next scan.
  double nextTime() const { return time_ + period_; }
  void wait(double seconds) { time_ += seconds; }

  /// Returns one normal value of standard deviation `sigma`, seeded.
  double noise(double sigma) { return std::normal_distribution<double>(0.0, sigma)(engine_); }

  Tracker& tracker() { return tracker_; }
  const TrackList& tracks() const { return tracks_; }

 private:
  Tracker tracker_;
  double period_;
  double time_ = 100.0;
  TrackList tracks_;
  std::mt19937_64 engine_{11};
};

}  // namespace datmo
