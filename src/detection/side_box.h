// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "datmo_fusion/detection/box_fit.h"

namespace datmo {

constexpr std::size_t indexOf(BoxSide side) { return static_cast<std::size_t>(side); }

constexpr std::size_t opposite(std::size_t side) { return side ^ 1U; }

/// A fitted box given by how far its sides are from its middle, to be moved one by one.
class SideBox {
 public:
  /// `fit` must outlive this.
  explicit SideBox(const BoxFit& fit)
      : fit_(fit),
        reach_{0.5 * fit.box.length, 0.5 * fit.box.length, 0.5 * fit.box.width,
               0.5 * fit.box.width} {}

  /// Unit vector out of the box.
  Point2 normal(std::size_t side) const;

  bool isSeen(std::size_t side) const { return fit_.points_on_side[side] > 0; }

  /// How many points lie on the sides that end at this one.
  std::size_t pointsUpTo(std::size_t side) const;

  /// Whether a side that was seen ends at this one. With a vague heading (`heading_std`, rad), what
  /// seems to be the shorter one of two sides may be none: its ends carry no information.
  bool isEndOfSeen(std::size_t side, double heading_std) const;

  /// m, of the box along a side whose opposite was seen: a turn of the box moves the position of
  /// the side, relative to that one, by so much times its angle.
  double across(std::size_t side) const;

  void extend(std::size_t side, double by) { reach_[side] += by; }

  Box2 box() const;

 private:
  const BoxFit& fit_;
  std::array<double, kBoxSides> reach_;  ///< m, by BoxSide
};

/// Turns the object by quarters, without moving it, until its heading is along its longer side, in
/// (-pi/2, pi/2].
void turnToLongerSide(Object& object);

}  // namespace datmo
