// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/scan.h"

namespace datmo {

/// The end of a beam, as a sample of the surface that it hit.
struct EndPoint {
  Point2 position = Point2::Zero();                    ///< m, base frame
  Eigen::Matrix2d sampling = Eigen::Matrix2d::Zero();  ///< m^2, base frame
};

/// Returns the ends of the beams that hit something, by ascending beam index.
///
/// Beams hit a surface at arbitrary points: seen from slightly further on, the same surface is
/// sampled anywhere between two of them. `sampling` is this uncertainty, a uniform distribution
/// over the step to the neighboring end points. Neighbors within `max_step` (m) are assumed to lie
/// on the same surface. Without any, the step is the shorter one (a surface hit at a grazing
/// angle), or, for an end point in front of both neighbors (a separate object), the beam spacing
/// across the line of sight.
std::vector<EndPoint> endPoints(const Scan& scan, double max_step);

}  // namespace datmo
