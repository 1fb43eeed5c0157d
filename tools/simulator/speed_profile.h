// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace datmo::simulator {

/// A speed that is reached at a time; in between the speed changes linearly.
struct SpeedPoint {
  double time = 0.0;   ///< s
  double speed = 0.0;  ///< m/s, at least 0
};

/// Speed over time by key points: constant before the first and after the last, with constant
/// acceleration between neighbors.
class SpeedProfile {
 public:
  /// Throws std::invalid_argument without points, for times that do not rise and for a speed that
  /// is negative or not finite.
  explicit SpeedProfile(std::vector<SpeedPoint> points);

  /// m/s at a time (s).
  double speed(double time) const;

  /// Distance driven since time 0, m.
  double distance(double time) const;

 private:
  double distanceBetween(double from, double to) const;

  std::vector<SpeedPoint> points_;
};

}  // namespace datmo::simulator
