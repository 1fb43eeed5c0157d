// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/box_size.h"
#include "datmo_fusion/tracking/center_gate.h"
#include "datmo_fusion/tracking/kalman_filter.h"

namespace datmo {

struct TrackedBoxOptions {
  BoxSizeOptions size;
  double heading_drift = 0.05;  ///< rad^2/s
  /// rad, 0 to 1: standard deviation of the angle between heading and velocity of the center: it is
  /// not zero in turns
  double slip_std = 0.05;
  double reverse_speed = 3.0;  ///< m/s
  /// s, 0 to 1000: nothing moves backward for longer, nor for longer than it has moved forward
  /// before
  double reverse_time = 10.0;

  void visit(OptionVisitor& visitor);
};

/// Heading and size of a tracked object; its position is the filter's.
///
/// The filter follows the center, but the visible parts of an object are its near sides. The center
/// is measured from them: with two opposite sides visible it is midway between them, with one it is
/// half the current size behind it (the anchor point of Petrovskaya & Thrun, Model based vehicle
/// detection and tracking for autonomous urban driving, 2009, section 3.1). So neither a side that
/// comes into view nor a better estimate of the size appears as motion. The error of the size is
/// the same in every scan and hence not measurement noise: it is a considered parameter of the
/// filter (Schmidt 1966), whose contribution to the center is `centerCovariance`.
///
/// The sides do not tell front from rear, nor reliably length from width: motion does. Cheap to
/// copy.
class TrackedBox {
 public:
  /// Starts from the first object, in the fixed frame.
  TrackedBox(const Object& object, const TrackedBoxOptions& options);

  /// Predicts `seconds` >= 0 ahead.
  void predict(double seconds, const TrackedBoxOptions& options);

  /// Returns the center of this box (m, fixed frame), measured from the visible sides of the
  /// object. Its covariance contains what varies from scan to scan, and, if other sides are visible
  /// than last time, the effect of the uncertain size on that change.
  PositionMeasurement measurementOf(const Object& object) const;

  /// Returns the gate for a center with this estimate; `gate`: squared Mahalanobis distance.
  CenterGate gateOf(const StateEstimate& estimate, double gate) const;

  /// Updates with the size, class and heading of an object, `seconds` >= 0 after the last one.
  /// Returns the shift of the center (m, fixed frame) that results because size or heading are
  /// better known while the visible sides stay where they are.
  Point2 update(const Object& object, double seconds, const TrackedBoxOptions& options);

  /// Updates with a significant velocity (m/s, fixed frame) and its covariance, which decides which
  /// side is the front, and the heading if it is more certain than the sides. Returns the shift of
  /// the center, as `update` does.
  Point2 followVelocity(const Eigen::Vector2d& velocity, const Eigen::Matrix2d& covariance,
                        const TrackedBoxOptions& options);

  /// The object stands: this time counts neither as forward nor as backward motion.
  void stand() { since_velocity_ = 0.0; }

  /// Returns the contribution of uncertain size and heading to the covariance of the center, m^2,
  /// fixed frame; it is not part of the filter's covariance.
  Eigen::Matrix2d centerCovariance() const;

  Box2 at(const Point2& center) const;

  /// Returns the variance of the heading, rad^2; modulo pi while its sign is unknown.
  double headingVariance() const;

  /// Returns whether motion has decided which of the two ends is the front.
  bool signKnown() const { return sign_known_; }

  /// Returns the likelihood of its size for each kind of road user.
  RoadUserLikelihoods sizeLikelihoods(const TrackedBoxOptions& options) const {
    return size_.likelihoods(options.size);
  }

  /// Returns the variance of length and width, m^2.
  const Eigen::Vector2d& sizeVariance() const { return size_.variance(); }

 private:
  Eigen::Vector2d offset() const;
  void turnByQuarters(int quarters);
  void setFrontAhead(double direction, double speed, const TrackedBoxOptions& options);
  void updateHeading(double measured, double variance);
  void setHeading(double heading);

  double heading_;
  Eigen::Matrix2d axes_;  ///< as columns; used for each object that may belong to the target
  double heading_variance_;
  double since_velocity_ = 0.0;  ///< s
  /// s, how much longer it moved forward than backward; below 0 it is turned around.
  double ahead_ = 0.0;
  bool sign_known_ = false;
  BoxSize size_;
  /// The last measured center is `anchor + share * size`, along each axis: -0.5 behind the front
  /// (left) side, 0 midway between two sides, 0.5 ahead of the rear (right) side.
  Eigen::Vector2d anchor_share_ = Eigen::Vector2d::Zero();
};

}  // namespace datmo
