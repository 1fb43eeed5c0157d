// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/fusion/object/object_fuser.h"

namespace datmo {

constexpr std::size_t sideIndex(BoxSide side) { return static_cast<std::size_t>(side); }

/// A valid object without size, of which only the position is known; `sigma` in m, along each axis.
inline Object pointObject(double x, double y, double sigma, const std::string& sensor = "lidar") {
  Object object;
  object.box.center = Pose2(x, y, 0.0);
  object.position_covariance = Eigen::Matrix2d::Identity() * sigma * sigma;
  object.sensors = {sensor};
  return object;
}

/// A box along x of which all sides are measured with this variance (m^2).
inline Object boxObject(double x, double y, double length, double width, double side_variance,
                        const std::string& sensor = "lidar") {
  Object object = pointObject(x, y, 0.1, sensor);
  object.box.length = length;
  object.box.width = width;
  object.heading_variance = 0.001;
  object.side_variance.fill(side_variance);
  return object;
}

inline void hide(Object& object, BoxSide side) {
  object.side_variance[sideIndex(side)] = kHiddenSide;
}

inline const Stamp kReference = Stamp::fromSeconds(5.0);

/// A source's list at this time, and the vehicle's pose at that time.
inline SourceObjects received(const std::string& source, std::vector<Object> objects,
                              double seconds = 5.0, const Pose2& base_in_reference = Pose2()) {
  return {source, {Stamp::fromSeconds(seconds), std::move(objects), {}}, base_in_reference};
}

/// 81 beams, one degree apart, facing ahead; those within 5 degrees end at this range.
inline LabeledScan scanAhead(double range, PointState state) {
  LabeledScan scan;
  scan.stamp = kReference;
  scan.field = {-degrees(40.0), degrees(1.0), 81, 0.5, 80.0, 80.0, 0.0};
  for (std::uint32_t beam = 35; beam <= 45; ++beam) {
    const double bearing = scan.field.first_bearing + beam * scan.field.beam_spacing;
    scan.points.push_back(
        {range * Point2(std::cos(bearing), std::sin(bearing)), range, bearing, beam, state});
  }
  return scan;
}

}  // namespace datmo
