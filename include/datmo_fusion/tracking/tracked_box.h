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
  double slip_std = 0.05;       ///< rad
  double reverse_speed = 3.0;   ///< m/s
  double reverse_time = 10.0;   ///< s

  void visit(OptionVisitor& visitor);
};

/// Heading and size of a tracked object; its position is the filter's.
///
/// The filter follows the center, but what is seen of an object are its near sides. The center is
/// measured from them: with both opposite sides seen it lies between them, with one it lies half
/// the present size behind it (the anchor point of Petrovskaya & Thrun, Model based vehicle
/// detection and tracking for autonomous urban driving, 2009, section 3.1). So neither a side that
/// comes into view nor a size that becomes better known is motion. The error of the size is the
/// same in every scan, hence no measurement noise: it is a considered parameter of the filter
/// (Schmidt 1966), whose part in the center is `centerCovariance`.
///
/// The sides do not distinguish front from rear, nor surely length from width: motion does. Cheap
/// to copy.
class TrackedBox {
 public:
  /// From the first object, in the fixed frame.
  TrackedBox(const Object& object, const TrackedBoxOptions& options);

  /// To `seconds` >= 0 ahead.
  void predict(double seconds, const TrackedBoxOptions& options);

  /// The center of this box (m, fixed frame), from the visible sides of the object. Its covariance
  /// has what differs from scan to scan; where the sides seen are not those of the last time, also
  /// what the unknown size makes of that.
  PositionMeasurement measurementOf(const Object& object) const;

  /// Of a center that is estimated so, as far as `gate` (Mahalanobis distance squared).
  CenterGate gateOf(const StateEstimate& estimate, double gate) const;

  /// Takes in the size, class and heading of an object, `seconds` >= 0 after the last one. Returns
  /// by how much the center moves (m, fixed frame), because size or heading are known better now
  /// while the sides that were seen stay where they are.
  Point2 update(const Object& object, double seconds, const TrackedBoxOptions& options);

  /// Updates with a significant velocity (m/s, fixed frame) and its covariance, which decides which
  /// side is the front, and the heading if it is surer than the sides. Returns by how much the
  /// center moves, as `update` does.
  Point2 followVelocity(const Eigen::Vector2d& velocity, const Eigen::Matrix2d& covariance,
                        const TrackedBoxOptions& options);

  /// What the unknown size and heading add to the covariance of the filter's position, m^2, fixed
  /// frame; the filter does not know of it.
  Eigen::Matrix2d centerCovariance() const;

  Box2 at(const Point2& center) const;

  /// rad^2, of the heading; where the sign is not known, modulo pi.
  double headingVariance() const;

  /// Motion has decided which of the two ends is the front.
  bool signKnown() const { return sign_known_; }

  /// How likely its size is of each road user.
  RoadUserLikelihoods sizeLikelihoods(const TrackedBoxOptions& options) const {
    return size_.likelihoods(options.size);
  }

  /// m^2, of length and width.
  const Eigen::Vector2d& sizeVariance() const { return size_.variance(); }

 private:
  Eigen::Vector2d offset() const;
  void turnByQuarters(int quarters);
  void takeFrontAhead(double direction, double speed, const TrackedBoxOptions& options);
  void updateHeading(double measured, double variance);
  void setHeading(double heading);

  double heading_;
  Eigen::Matrix2d axes_;  ///< as columns: asked for with each object that may be of the target
  double heading_variance_;
  double since_velocity_ = 0.0;  ///< s
  /// s, how much longer it moved ahead than backward; below 0 it turns round.
  double ahead_ = 0.0;
  bool sign_known_ = false;
  BoxSize size_;
  /// The center that was measured last is `anchor + share * size`, along each axis: -0.5 behind the
  /// front (left) side, 0 midway between two sides, 0.5 ahead of the rear (right) side.
  Eigen::Vector2d anchor_share_ = Eigen::Vector2d::Zero();
};

}  // namespace datmo
