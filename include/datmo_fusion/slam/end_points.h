// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/scan.h"

namespace datmo {

/// Where a beam ends, as a sample of the surface that it hit.
struct EndPoint {
  Point2 position = Point2::Zero();                    ///< m, base frame
  Eigen::Matrix2d sampling = Eigen::Matrix2d::Zero();  ///< m^2, base frame
};

/// The ends of a scan's beams that hit something, by rising beam index.
///
/// Beams hit a surface at arbitrary points: the same surface, seen from a little further on, is
/// sampled anywhere between two of them. `sampling` is this uncertainty, as a uniform distribution
/// over the step to the neighboring end points. Neighbors within `max_step` (m) lie on the
/// same surface; where there is none, the step is the shorter one (a surface met at a flat angle),
/// or, for an end point in front of both neighbors (an object of its own), the spacing of the
/// beams across the line of sight.
std::vector<EndPoint> endPoints(const Scan& scan, double max_step);

}  // namespace datmo
