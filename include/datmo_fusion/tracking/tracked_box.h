#pragma once

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/kalman_filter.h"

namespace datmo {

struct TrackedBoxOptions {
  double growth_time = 0.2;     ///< s
  double shrink_time = 5.0;     ///< s
  double heading_drift = 0.05;  ///< rad^2/s
  double reverse_speed = 3.0;   ///< m/s

  void visit(OptionVisitor& visitor);
};

/// Heading and size of a tracked object; its position is the filter's.
///
/// One measurement shows a part of the object, so the size follows larger ones quickly and smaller
/// ones slowly. The sides seen do not tell front from rear, nor length from width; the first
/// significant motion does, and later objects turn the box no farther than to their nearest side.
/// Shape models (thesis 4.2.4) take the place of this class in a later issue.
class TrackedBox {
 public:
  /// From the first object, in the fixed frame.
  explicit TrackedBox(const Object& object);

  void predict(double seconds, const TrackedBoxOptions& options);

  /// Takes in the size and heading of an object `seconds` after the last one.
  void update(const Object& object, double seconds, const TrackedBoxOptions& options);

  /// Takes in the direction of a significant velocity (m/s) with its covariance.
  void followVelocity(const Eigen::Vector2d& velocity, const Eigen::Matrix2d& covariance,
                      const TrackedBoxOptions& options);

  /// The object's centre, as a measurement of the centre of this box: where only a part of the box
  /// is seen, that part may lie anywhere along it, so its centre is off by up to half of the
  /// difference.
  PositionMeasurement measurementOf(const Object& object) const;

  Box2 at(const Point2& centre) const;

 private:
  void updateHeading(double measured, double variance);
  Eigen::Vector2d sizeOf(const Object& object) const;

  double heading_;
  double heading_variance_;
  bool sign_known_ = false;
  Eigen::Vector2d size_;  ///< m, along the heading and across
};

}  // namespace datmo
