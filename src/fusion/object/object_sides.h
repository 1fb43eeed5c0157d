// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// The two sides of a box that are across one axis.
struct SidePair {
  std::array<double, 2> position{};  ///< m along the axis: of the side behind, of the one ahead
  std::array<double, 2> variance{};  ///< m^2, by itself; kHiddenSide: not seen

  bool isSeen(std::size_t end) const { return std::isfinite(variance[end]); }
  double extent() const { return position[1] - position[0]; }
  double middle() const { return 0.5 * (position[0] + position[1]); }
};

/// An object given in the axes.
struct ObjectSides {
  std::array<SidePair, 2> along;  ///< along the x axis and the y axis
  Eigen::Matrix2d covariance;     ///< m^2, of the box as a whole
};

/// What is known of the heading of two objects together, taken for one.
struct CommonHeading {
  double heading = 0.0;   ///< rad, nearest to that of the surer one
  double variance = 0.0;  ///< rad^2
  bool same_axis = true;  ///< both take the same axis for their length
};

/// The sides of two boxes are distinguished modulo a quarter turn only; so headings are merged, by
/// what is known of each. Where they contradict each other, that of the box holds which would lose
/// most by being turned: large and well measured.
CommonHeading commonHeading(const Object& a, const Object& b);

/// In which two objects are given.
struct CommonAxes {
  CommonAxes(const Object& a, const Object& b, const CommonHeading& common)
      : pose(0.5 * (a.box.center.position() + b.box.center.position()), common.heading),
        rotation(pose.rotation()) {}

  Pose2 pose;                ///< midway between both, along their common heading
  Eigen::Matrix2d rotation;  ///< from the axes
};

/// Each side of the object is that of the axes' ends which it is nearest to. A box that is turned
/// for it has sides that are known less well; one that is turned far shows a corner there, of
/// which both sides must have been seen.
ObjectSides sidesIn(const CommonAxes& axes, const Object& object);

}  // namespace datmo
