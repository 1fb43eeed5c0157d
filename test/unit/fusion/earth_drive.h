// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>

#include <Eigen/Core>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/fusion/earth/earth_frame_filter.h"

namespace datmo {

/// A drive along a curve, measured by a receiver with white noise and a drifting error.
class Drive {
 public:
  Drive(unsigned seed, double sigma, const EarthFrameOptions& options, bool drifts = false)
      : random_(seed), sigma_(sigma), options_(options), drifts_(drifts) {
    shared_ = std::sqrt(options.correlated_share) * sigma_ * draw2();
  }

  EarthFix next() {
    const double keep = std::exp(-kPeriod / options_.correlation_time);
    shared_ = keep * shared_ +
              std::sqrt(options_.correlated_share * (1.0 - keep * keep)) * sigma_ * draw2();
    time_ += kPeriod;
    const double angle = 0.02 * time_;
    const Pose2 base(500.0 * std::sin(angle), 500.0 * (1.0 - std::cos(angle)), angle);
    const double distance = drifts_ ? 500.0 * 0.02 * kPeriod : 0.0;
    const double turn = std::sqrt(distance) * options_.map_turn * normal_(random_);
    const Point2 there = truth_ * base.position();  // about which the map turns
    const Pose2 turned(0.0, 0.0, truth_.heading() + turn);
    truth_ = Pose2(
        there - turned.rotate(base.position()) + std::sqrt(distance) * options_.map_drift * draw2(),
        turned.heading());
    EarthFix fix;
    fix.stamp = Stamp::fromSeconds(100.0 + time_);
    fix.base_in_map = {base, 1e-4 * Eigen::Matrix3d::Identity()};
    fix.antenna_in_base = {1.2, 0.3};
    fix.in_plane = truth_ * (fix.base_in_map.pose * fix.antenna_in_base) + shared_ +
                   std::sqrt(1.0 - options_.correlated_share) * sigma_ * draw2();
    fix.covariance = sigma_ * sigma_ * Eigen::Matrix2d::Identity();
    return fix;
  }

  const Pose2& truth() const { return truth_; }

 private:
  static constexpr double kPeriod = 0.2;  // s
  Point2 draw2() {
    const double x = normal_(random_);
    return {x, normal_(random_)};
  }

  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  double sigma_;
  EarthFrameOptions options_;
  bool drifts_;  ///< the map drifts, as in the options
  Pose2 truth_{120.0, -60.0, 2.2};
  Point2 shared_ = Point2::Zero();
  double time_ = 0.0;
};

inline Eigen::Vector3d errorOf(const Pose2& estimate, const Pose2& truth) {
  Eigen::Vector3d error;
  error << estimate.position() - truth.position(),
      normalizeAngle(estimate.heading() - truth.heading());
  return error;
}

}  // namespace datmo
