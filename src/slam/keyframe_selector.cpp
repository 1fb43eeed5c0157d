// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/keyframe_selector.h"

#include <cmath>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo {

namespace {

/// Standard deviations (max_position_sigma) by which a known pose may still be corrected.
constexpr double kCorrectionSigmas = 3.0;

}  // namespace

void KeyframeOptions::visit(OptionVisitor& visitor) {
  visitor.number({"distance", "m", "distance from one keyframe to the next"}, distance,
                 {0.05, 100.0});
  visitor.number({"turn", "rad", "or this turn"}, turn, {0.01, kPi});
  visitor.number({"new_map_after", "s",
                  "a pose that stays uncertain for this long is in a new map; more than "
                  "grid_slam's recovery/kidnapped_after and give_up_after together"},
                 new_map_after, {0.1, 3600.0});
  visitor.number({"max_speed", "m/s",
                  "a pose farther from the last one than this speed allows is in a new map: the "
                  "SLAM has restarted"},
                 max_speed, {0.1, 1000.0});
}

KeyframeSelector::KeyframeSelector(const Checked<KeyframeOptions>& options) : options_(*options) {}

bool KeyframeSelector::isFarBelow(const Eigen::Matrix3d& known,
                                  const Eigen::Matrix3d& other) const {
  const Eigen::Matrix3d more = other - known;
  return maxPositionVariance(more) > square(options_.max_position_sigma) ||
         more(2, 2) > square(options_.max_heading_sigma);
}

bool KeyframeSelector::isLeap(Stamp stamp, const Pose2& pose) const {
  const double max_distance = options_.max_speed * secondsBetween(known_.stamp, stamp) +
                              kCorrectionSigmas * options_.max_position_sigma;
  return (pose.position() - known_.pose.position()).norm() > max_distance;
}

KeyframeSelector::Use KeyframeSelector::startAt(Stamp stamp,
                                                const PoseWithCovariance& base_in_map) {
  last_ = base_in_map;
  known_ = {stamp, base_in_map.pose};
  uncertain_since_.reset();
  return Use::kFirst;
}

KeyframeSelector::Use KeyframeSelector::select(Stamp stamp, const PoseWithCovariance& base_in_map) {
  const Pose2& pose = base_in_map.pose;
  const Eigen::Matrix3d expected =
      last_ ? withLeverArm(last_->covariance, pose.position() - last_->pose.position())
            : Eigen::Matrix3d::Zero();
  if (isFarBelow(expected, base_in_map.covariance)) {
    uncertain_since_ = uncertain_since_.value_or(stamp);
    return secondsBetween(*uncertain_since_, stamp) < options_.new_map_after
               ? Use::kNothing
               : startAt(stamp, base_in_map);
  }
  // A long gap by itself widens the expected covariance.
  const bool is_found = last_ && isFarBelow(base_in_map.covariance, expected) &&
                        isFarBelow(base_in_map.covariance, last_->covariance);
  if (!last_ || is_found || isLeap(stamp, pose)) {
    return startAt(stamp, base_in_map);
  }
  uncertain_since_.reset();
  known_ = {stamp, pose};
  const Pose2 since = last_->pose.inverse() * pose;
  if (since.position().norm() < options_.distance && std::abs(since.heading()) < options_.turn) {
    return Use::kPose;
  }
  last_ = base_in_map;
  return Use::kKeyframe;
}

void KeyframeSelector::reset() {
  last_.reset();
  uncertain_since_.reset();
}

}  // namespace datmo
