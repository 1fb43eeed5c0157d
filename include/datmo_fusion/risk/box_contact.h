// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "datmo_fusion/common/box2.h"

namespace datmo {

/// Center and heading of a rectangle, with the direction of its length precomputed.
struct BodyPose {
  Point2 center = Point2::Zero();       ///< m, fixed frame
  double heading = 0.0;                 ///< rad, continuous: it may exceed pi
  Point2 direction = Point2(1.0, 0.0);  ///< of length 1, along the heading
};

BodyPose bodyPose(const Point2& center, double heading);

/// Half the size of a rectangle.
struct BodySize {
  double half_length = 0.0;  ///< m, at least 0
  double half_width = 0.0;   ///< m, at least 0

  /// Radius of the circle about the center that encloses the rectangle, m.
  double radius() const;
};

BodySize bodySize(const Box2& box);

/// Returns how far a rectangle extends from its center along an axis of length 1, m.
double reachAlong(const Point2& axis, const BodyPose& pose, const BodySize& size);

/// A gap between two rectangles along a direction that separates them.
struct Separation {
  double gap = 0.0;               ///< m; 0 or less: they touch or overlap, by at most this much
  Point2 axis = Point2::UnitX();  ///< of length 1, from the first to the second
};

/// Returns the largest gap between two rectangles along the directions of their sides. It never
/// exceeds their distance, and is positive exactly if they have no point in common (separating axis
/// theorem; Ericson, Real-Time Collision Detection, 2005, 4.4.1).
Separation separation(const BodyPose& a, const BodySize& size_a, const BodyPose& b,
                      const BodySize& size_b);

/// A rectangle that moves uniformly from one pose to another: its center along a line, with a
/// constant turn rate.
struct BodyMove {
  BodyPose from;
  BodyPose to;
  BodySize size;

  /// `share`: 0 to 1 of the move.
  BodyPose at(double share) const;
};

/// m; closer than this is contact: no track is that accurate.
inline constexpr double kTouching = 0.01;

/// A circle that moves uniformly along a line.
struct CircleMove {
  Point2 from = Point2::Zero();  ///< m
  Point2 to = Point2::Zero();    ///< m
  double radius = 0.0;           ///< m
};

/// Returns whether two circles that move at the same time touch: if the circles around two
/// rectangles do not, neither do the rectangles. Inline, as it is called for every step of every
/// future.
inline bool circlesMeet(const CircleMove& a, const CircleMove& b) {
  const Point2 apart = b.from - a.from;
  const Point2 drift = (b.to - b.from) - (a.to - a.from);
  const double reach = a.radius + b.radius + kTouching;
  const double farthest = reach + drift.lpNorm<1>();
  if (apart.squaredNorm() > farthest * farthest) {
    return false;  // the usual case; avoids the slow division
  }
  const double length = drift.squaredNorm();
  const double nearest = length > 0.0 ? std::clamp(-apart.dot(drift) / length, 0.0, 1.0) : 0.0;
  return (apart + nearest * drift).squaredNorm() <= reach * reach;
}

/// Returns the share (0 to 1) of two simultaneous moves at which the rectangles first touch, to
/// within 1 cm; none if they do not. No contact that lasts for 2.5e-4 of the moves is missed,
/// however long they are, thanks to conservative advancement along the separating axis (Mirtich,
/// Impulse-based Dynamic Simulation, 1996, 2.3.2).
std::optional<double> firstContact(const BodyMove& a, const BodyMove& b);

/// Side of a rectangle that faces a touching one; values as in Risk.msg.
enum class StruckSide : std::uint8_t { kNone, kFront, kRear, kLeft, kRight };

/// Returns one lower-case word.
const char* nameOf(StruckSide side);

/// Returns the side of `a` that touches `b`: the one with the least overlap, measured along the
/// sides of `a`.
StruckSide struckSide(const BodyPose& a, const BodySize& size_a, const BodyPose& b,
                      const BodySize& size_b);

}  // namespace datmo
