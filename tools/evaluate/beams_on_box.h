// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/common/box2.h"
#include "datmo_fusion/common/scan.h"

namespace datmo::evaluation {

/// A beam that ends on an object; unit vectors in the frame of the scan.
struct BeamOnBox {
  Point2 direction = Point2::Zero();  ///< of the beam
  Point2 normal = Point2::Zero();     ///< outward, of the side at which it enters the box
};

/// The interval across the line of sight within which the beams allow an object of known shape to
/// shift.
struct LateralInterval {
  Point2 axis = Point2::Zero();  ///< unit vector
  double width = 0.0;            ///< m, greater than 0
};

/// The observation of a box by one scan.
struct BoxObservation {
  std::vector<BeamOnBox> beams;
  std::optional<LateralInterval> lateral;  ///< none: no beam, or no limit to one side
};

/// Returns which beams of the scan end on the box, and how far it could shift before another beam
/// hit it or one of these missed it: with the bearings of the box's ends a0 < a1, of its first and
/// last beam b0 <= b1, and of those next to its ends, b- < a0 and b+ > a1, it can turn about the
/// scanner by
///
///     max(b- - a0, b1 - a1) to min(b0 - a0, b+ - a1).
///
/// A beam that ends on an obstacle in front of the box is not a limit.
///
/// `box`: frame of the scan; `tolerance` (m, at least 0): how far outside the box a beam may end.
BoxObservation observeBox(const Scan& scan, const Box2& box, double tolerance);

}  // namespace datmo::evaluation
