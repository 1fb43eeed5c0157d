// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/speed_profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace datmo::simulator {

SpeedProfile::SpeedProfile(std::vector<SpeedPoint> points) : points_(std::move(points)) {
  if (points_.empty()) {
    throw std::invalid_argument("a speed profile of 0 points: expected at least 1");
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const SpeedPoint& point = points_[i];
    if (!std::isfinite(point.time) || !std::isfinite(point.speed) || point.speed < 0.0) {
      throw std::invalid_argument("speed point " + std::to_string(i) + " is [" +
                                  std::to_string(point.time) + ", " + std::to_string(point.speed) +
                                  "]: expected a time in s and a speed of at least 0 m/s");
    }
    if (i > 0 && !(point.time > points_[i - 1].time)) {
      throw std::invalid_argument("speed point " + std::to_string(i) + " has time " +
                                  std::to_string(point.time) + " s: expected more than the " +
                                  std::to_string(points_[i - 1].time) + " s before it");
    }
  }
}

double SpeedProfile::speed(double time) const {
  if (time <= points_.front().time) {
    return points_.front().speed;
  }
  if (time >= points_.back().time) {
    return points_.back().speed;
  }
  const auto next =
      std::upper_bound(points_.begin(), points_.end(), time,
                       [](double t, const SpeedPoint& point) { return t < point.time; });
  const auto last = std::prev(next);
  const double share = (time - last->time) / (next->time - last->time);
  return last->speed + share * (next->speed - last->speed);
}

double SpeedProfile::distance(double time) const {
  double driven = 0.0;
  double since = 0.0;
  for (const SpeedPoint& point : points_) {
    if (point.time > since && point.time < time) {
      driven += distanceBetween(since, point.time);
      since = point.time;
    }
  }
  return driven + distanceBetween(since, time);
}

double SpeedProfile::distanceBetween(double from, double to) const {
  return 0.5 * (speed(from) + speed(to)) * (to - from);
}

}  // namespace datmo::simulator
