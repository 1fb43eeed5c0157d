// SPDX-License-Identifier: BSD-3-Clause
#include "side_box.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/object_turn.h"

namespace datmo {

namespace {

/// rad; with a vaguer heading, what seems to be two sides may be one.
constexpr double kSureOfCorner = 0.15;

}  // namespace

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

}  // namespace datmo
