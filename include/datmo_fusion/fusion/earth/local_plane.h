// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// A position on the earth, WGS 84.
struct GeodeticPosition {
  double latitude = 0.0;   ///< rad
  double longitude = 0.0;  ///< rad
  double altitude = 0.0;   ///< m, above the ellipsoid
};

/// Whether the position is finite and on the earth.
bool isValid(const GeodeticPosition& position);

/// The plane tangent at a datum to the surface parallel to the ellipsoid: x to the east, y to the
/// north, m. Within 10 km of the datum heights of 100 m shift a point by less than 0.2 m.
class LocalPlane {
 public:
  explicit LocalPlane(const GeodeticPosition& datum);

  const GeodeticPosition& datum() const { return datum_; }

  Point2 toPlane(const GeodeticPosition& position) const;

  /// Converts a point in the plane; the altitude is that of the earth's surface below it.
  GeodeticPosition toGeodetic(const Point2& point) const;

 private:
  GeodeticPosition datum_;
  Eigen::Vector3d origin_;  ///< m, earth-centered, earth-fixed
  Eigen::Matrix3d axes_;    ///< rows: east, north, up
};

}  // namespace datmo
