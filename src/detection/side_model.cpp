// SPDX-License-Identifier: BSD-3-Clause
#include "side_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/object_turn.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// rad; if the heading is less certain, what seems to be two sides may be one.
constexpr double kSureOfCorner = 0.15;

/// rad; maximum deviation of the heading: a visible side faces the sensor.
constexpr double kMaxSlant = 0.3;

constexpr std::size_t indexOf(BoxSide side) { return static_cast<std::size_t>(side); }

constexpr std::size_t opposite(std::size_t side) { return side ^ 1U; }

/// A fitted box, given by the distances of its sides from its middle, which are moved one by one.
class SideBox {
 public:
  /// `fit` must outlive this object.
  explicit SideBox(const BoxFit& fit)
      : fit_(fit),
        reach_{0.5 * fit.box.length, 0.5 * fit.box.length, 0.5 * fit.box.width,
               0.5 * fit.box.width} {}

  /// Outward unit normal.
  Point2 normal(std::size_t side) const;

  bool isSeen(std::size_t side) const { return fit_.points_on_side[side] > 0; }

  /// Whether a visible side ends at this one. With an uncertain heading (`heading_std`, rad), the
  /// shorter one of two apparent sides may not exist: its ends carry no information.
  bool isEndOfSeen(std::size_t side, double heading_std) const;

  /// m, of the box along a side whose opposite was seen: a rotation of the box shifts the side,
  /// relative to the opposite one, by this times its angle.
  double across(std::size_t side) const;

  void extend(std::size_t side, double by) { reach_[side] += by; }

  Box2 box() const;

 private:
  /// Number of points on the sides that end at this one.
  std::size_t pointsUpTo(std::size_t side) const;

  const BoxFit& fit_;
  std::array<double, kBoxSides> reach_;  ///< m, by BoxSide
};

Point2 SideBox::normal(std::size_t side) const {
  static const std::array<Point2, kBoxSides> kNormals = {Point2(1.0, 0.0), Point2(-1.0, 0.0),
                                                         Point2(0.0, 1.0), Point2(0.0, -1.0)};
  return Pose2(Point2::Zero(), fit_.box.center.heading()).rotate(kNormals[side]);
}

std::size_t SideBox::pointsUpTo(std::size_t side) const {
  const std::size_t one =
      indexOf(side < indexOf(BoxSide::kLeft) ? BoxSide::kLeft : BoxSide::kFront);
  return fit_.points_on_side[one] + fit_.points_on_side[opposite(one)];
}

bool SideBox::isEndOfSeen(std::size_t side, double heading_std) const {
  const std::size_t min = heading_std < kSureOfCorner ? 0 : fit_.points_on_side[opposite(side)];
  return pointsUpTo(side) > 0 && pointsUpTo(side) >= min;
}

double SideBox::across(std::size_t side) const {
  const double extent = side < indexOf(BoxSide::kLeft) ? fit_.box.width : fit_.box.length;
  return isSeen(opposite(side)) ? extent : 0.0;
}

Box2 SideBox::box() const {
  const Point2 middle(0.5 * (reach_[0] - reach_[1]), 0.5 * (reach_[2] - reach_[3]));
  return {Pose2(fit_.box.center * middle, fit_.box.center.heading()), reach_[0] + reach_[1],
          reach_[2] + reach_[3]};
}

/// Turns the object by quarters, without moving it, until its heading is along its longer side, in
/// (-pi/2, pi/2].
void turnToLongerSide(Object& object) {
  if (object.box.width > object.box.length) {
    turnByQuarter(object);
  }
  const double heading = object.box.center.heading();
  if (heading > kQuarterTurn || heading <= -kQuarterTurn) {
    turnByQuarter(object);
    turnByQuarter(object);
  }
}

}  // namespace

void setSides(Object& object, const BoxFit& fit, const SideModel& model) {
  const double heading_std = std::sqrt(std::min(fit.heading_variance, square(kMaxSlant)));
  SideBox sides(fit);
  for (std::size_t side = 0; side < kBoxSides; ++side) {
    object.side_variance[side] = kHiddenSide;
    if (sides.isSeen(side)) {
      object.side_variance[side] = model.seen_variance(fit.points_on_side[side]);
    } else if (sides.isEndOfSeen(side, heading_std)) {
      if (const auto end = model.end_beyond(sides.normal(side), heading_std)) {
        sides.extend(side, end->beyond);
        object.side_variance[side] = end->variance + square(heading_std * sides.across(side));
      }
    }
  }
  object.box = sides.box();
  object.heading_variance = fit.heading_variance;
  turnToLongerSide(object);
}

}  // namespace datmo
