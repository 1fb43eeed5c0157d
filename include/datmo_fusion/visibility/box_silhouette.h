// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/box2.h"

namespace datmo {

/// Distances at which a straight line enters and leaves a box, m from its start.
struct LineCrossing {
  double entry;
  double exit;
};

/// A box as seen from a sensor, in the frame of the box. Sides are taken to be at least 0.1 m:
/// sensors detect nothing narrower.
class BoxSilhouette {
 public:
  /// `sensor`: in the frame in which the box is given, m.
  BoxSilhouette(const Box2& box, const Point2& sensor);

  const Point2& sensor() const { return sensor_; }  ///< m
  const Point2& half() const { return half_; }      ///< m, half of length and width
  double distance() const { return distance_; }     ///< m, from the sensor to the center
  double bearing() const { return bearing_; }       ///< rad, of the center from the sensor
  double right() const { return right_; }           ///< rad, edge, from the bearing; at most 0
  double left() const { return left_; }             ///< rad, edge, from the bearing; at least 0
  double width() const { return left_ - right_; }   ///< rad

  bool holdsSensor() const { return (sensor_.cwiseAbs() - half_).maxCoeff() <= 0.0; }

  /// Returns the crossing of the line from the sensor in this direction, a unit vector.
  LineCrossing crossing(const Point2& direction) const;

 private:
  Point2 half_;
  Point2 sensor_;
  double distance_;
  double bearing_;
  double right_ = 0.0;
  double left_ = 0.0;
};

}  // namespace datmo
