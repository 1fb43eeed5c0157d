// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "near_sides.h"

#include "datmo_fusion/detection/box_fit.h"

namespace datmo {

/// How badly each of some headings over a quarter turn explains points about a scanner, if they lie
/// on the sides of a rectangle that face it.
class HeadingSearch {
 public:
  HeadingSearch(const Points& points, const PointNoise& noise);

  /// rad, the one that explains them best.
  double best() const { return heading(best_); }

  /// Variance of the likely headings about this one, modulo a quarter turn, rad^2; what the steps
  /// themselves make of it left out.
  double spreadAbout(double center) const;

 private:
  static constexpr std::size_t kHeadings = 15;

  static double heading(std::size_t i);

  std::array<double, kHeadings> costs_;
  std::size_t best_;
};

}  // namespace datmo
