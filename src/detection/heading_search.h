// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "near_sides.h"

#include "datmo_fusion/detection/box_fit.h"

namespace datmo {

/// Cost of each of a set of headings over a quarter turn, for points about a scanner that lie on
/// the sides of a rectangle facing it.
class HeadingSearch {
 public:
  HeadingSearch(const Points& points, const PointNoise& noise);

  /// Returns the heading with the lowest cost, rad.
  double best() const { return heading(best_); }

  /// Returns the variance of likely headings about this one, modulo a quarter turn, rad^2, without
  /// the part due to the steps.
  double spreadAbout(double center) const;

 private:
  static constexpr std::size_t kHeadings = 15;

  static double heading(std::size_t i);

  std::array<double, kHeadings> costs_;
  std::size_t best_;
};

}  // namespace datmo
