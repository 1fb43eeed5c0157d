// SPDX-License-Identifier: BSD-3-Clause
#include "object_sides.h"

#include <algorithm>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

/// rad^2; no object is a perfect rectangle.
constexpr double kMinHeadingVariance = 1e-6;

/// rad; headings that differ by more are not noisy versions of the same one: one of them is wrong.
constexpr double kMaxTurn = 0.3;

/// Information of a heading modulo a quarter turn, beyond that of a uniform distribution, 1/rad^2.
double informationOf(double variance) {
  return std::max(0.0, 1.0 / std::max(variance, kMinHeadingVariance) - 1.0 / kUnknownAxisVariance);
}

/// Cost of rotating an object's box: length over uncertainty, squared.
double stiffnessOf(const Object& object) {
  double sides = 0.0;
  double seen = 0.0;
  for (const double variance : object.side_variance) {
    if (std::isfinite(variance)) {
      sides += variance;
      seen += 1.0;
    }
  }
  const double variance =
      0.5 * object.position_covariance.trace() + (seen > 0.0 ? sides / seen : 0.0);
  const double reach = std::max(object.box.length, object.box.width);
  return reach * reach / variance;
}

}  // namespace

CommonHeading commonHeading(const Object& a, const Object& b) {
  const double from = a.box.center.heading();
  const double turn = angleBetween(from, b.box.center.heading());
  const double quarters = std::round(turn / kQuarterTurn);
  const double apart = turn - quarters * kQuarterTurn;
  const double of_a = informationOf(a.heading_variance);
  const double of_b = informationOf(b.heading_variance);
  const double known = of_a + of_b;
  double share_of_b = known > 0.0 ? of_b / known : 0.5;
  CommonHeading common;
  common.variance = known > 0.0 ? 1.0 / (known + 1.0 / kUnknownAxisVariance)
                                : std::min(a.heading_variance, b.heading_variance);
  if (std::abs(apart) > kMaxTurn) {
    const double stiffer = stiffnessOf(b) - stiffnessOf(a);
    share_of_b = stiffer > 0.0 || (stiffer == 0.0 && of_b > of_a) ? 1.0 : 0.0;
    common.variance = share_of_b > 0.0 ? b.heading_variance : a.heading_variance;
  }
  common.heading = normalizeAngle(from + share_of_b * apart +
                                  (share_of_b > 0.5 ? quarters * kQuarterTurn : 0.0));
  common.same_axis = std::lround(quarters) % 2 == 0;
  return common;
}

ObjectSides sidesIn(const CommonAxes& axes, const Object& object) {
  constexpr std::array<BoxSide, kBoxSides> kToTheLeft = {BoxSide::kFront, BoxSide::kLeft,
                                                         BoxSide::kRear, BoxSide::kRight};
  const Box2& box = object.box;
  const Eigen::Matrix2d to_axes = axes.rotation.transpose();
  const Point2 center = to_axes * (box.center.position() - axes.pose.position());
  const double turn = angleBetween(box.center.heading(), axes.pose.heading());
  const double quarters = std::round(turn / kQuarterTurn);
  const double slant = turn - quarters * kQuarterTurn;
  const auto first = static_cast<std::size_t>(std::lround(quarters) + 4);
  const bool across = first % 2 == 1;
  const Point2 half =
      0.5 * (across ? Point2(box.width, box.length) : Point2(box.length, box.width));
  ObjectSides sides;
  sides.covariance = to_axes * object.position_covariance * to_axes.transpose();
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double turned = std::sin(slant) * half[1 - i];
    for (std::size_t end = 0; end < 2; ++end) {
      const std::size_t direction = end == 1 ? axis : axis + 2;
      const auto variance = [&](std::size_t quarter) {
        return object.side_variance[static_cast<std::size_t>(kToTheLeft[quarter % kBoxSides])];
      };
      const double own = variance(first + direction);
      // The farthest point of a rotated box in that direction is a corner: both its sides count.
      const double other = variance(first + direction + (slant > 0.0 ? 1 : kBoxSides - 1));
      const bool is_seen = std::abs(slant) <= kMaxTurn || std::isfinite(other);
      sides.along[axis].position[end] = end == 1 ? center[i] + half[i] : center[i] - half[i];
      sides.along[axis].variance[end] = is_seen ? own + turned * turned : kHiddenSide;
    }
  }
  return sides;
}

}  // namespace datmo
