// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// The two sides of a box that are across one axis.
struct SidePair {
  std::array<double, 2> position{};  ///< m along the axis: of the rear side, of the front side
  std::array<double, 2> variance{};  ///< m^2, individual; kHiddenSide: not seen

  bool isSeen(std::size_t end) const { return std::isfinite(variance[end]); }
  double extent() const { return position[1] - position[0]; }
  double middle() const { return 0.5 * (position[0] + position[1]); }
};

/// An object in common axes.
struct ObjectSides {
  std::array<SidePair, 2> along;  ///< along the x axis and the y axis
  Eigen::Matrix2d covariance;     ///< m^2, of the box as a whole
};

/// Common heading of two objects that are assumed to be one.
struct CommonHeading {
  double heading = 0.0;   ///< rad, the representative nearest to the more certain one
  double variance = 0.0;  ///< rad^2
  bool same_axis = true;  ///< both have their length along the same axis
};

/// Merges the headings of two boxes. The sides of two boxes can only be distinguished modulo a
/// quarter turn, so headings are merged modulo that, weighted by certainty. If they contradict each
/// other, the heading of the box that would lose most by being rotated is used: large and well
/// measured.
CommonHeading commonHeading(const Object& a, const Object& b);

/// Axes in which two objects are given.
struct CommonAxes {
  CommonAxes(const Object& a, const Object& b, const CommonHeading& common)
      : pose(0.5 * (a.box.center.position() + b.box.center.position()), common.heading),
        rotation(pose.rotation()) {}

  Pose2 pose;                ///< midway between both, along their common heading
  Eigen::Matrix2d rotation;  ///< from the axes
};

/// Returns an object in the axes; each of its sides belongs to the nearest end of an axis. Rotating
/// a box makes its sides less certain; one that is rotated far shows a corner there, of which both
/// sides must have been seen.
ObjectSides sidesIn(const CommonAxes& axes, const Object& object);

}  // namespace datmo
