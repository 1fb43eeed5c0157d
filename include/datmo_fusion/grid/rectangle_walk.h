// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/grid/grid_window.h"

namespace datmo {

/// A rectangle of any orientation.
struct Rectangle {
  Pose2 center;         ///< m and rad, map frame
  double length = 0.0;  ///< m, along the heading
  double width = 0.0;   ///< m, across it
};

namespace detail {

/// Interval of a line within a rectangle, by the coordinate along the line; empty if `first` >
/// `last`.
struct Span {
  double first = -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();

  /// Keeps the part where |start + slope * coordinate| <= half.
  void cut(double start, double slope, double half) {
    if (slope == 0.0) {
      last = std::abs(start) > half ? -std::numeric_limits<double>::infinity() : last;
      return;
    }
    const double a = (-half - start) / slope;
    const double b = (half - start) / slope;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
};

}  // namespace detail

/// Calls `visit(CellIndex)`, row by row, for the cells of a window whose center lies in a
/// rectangle. Only those are touched (thesis 3.5 tests each cell in the axis-aligned bounding
/// rectangle).
template <typename Visit>
void walkRectangle(const GridWindow& window, const Rectangle& rectangle, Visit&& visit) {
  const double c = std::cos(rectangle.center.heading());
  const double s = std::sin(rectangle.center.heading());
  const double half_length = 0.5 * rectangle.length;
  const double half_width = 0.5 * rectangle.width;
  // Cells by their center: that of cell i along an axis is (i + 0.5) * cell_size. With min and max
  // in this order NaN becomes a limit, too.
  const auto lastUpTo = [&](double coordinate, int min, int max) {
    const double index = std::floor(coordinate / window.cell_size - 0.5);
    return static_cast<int>(std::min(max + 0.0, std::max(min - 1.0, index)));
  };
  const auto firstFrom = [&](double coordinate, int min, int max) {
    const double index = std::ceil(coordinate / window.cell_size - 0.5);
    return static_cast<int>(std::min(max + 1.0, std::max(min + 0.0, index)));
  };
  const CellIndex min = window.corner;
  const CellIndex max{min.column + window.columns - 1, min.row + window.rows - 1};
  const double reach = std::abs(s) * half_length + std::abs(c) * half_width;
  const double middle = rectangle.center.y();
  const int last_row = lastUpTo(middle + reach, min.row, max.row);
  for (int row = firstFrom(middle - reach, min.row, max.row); row <= last_row; ++row) {
    // Along the row, `x` from the rectangle's center: the inside lies between both long sides and
    // between both short ones.
    const double y = (row + 0.5) * window.cell_size - middle;
    detail::Span span;
    span.cut(s * y, c, half_length);
    span.cut(c * y, -s, half_width);
    if (span.first > span.last) {
      continue;
    }
    const double x = rectangle.center.x();
    const int last = lastUpTo(x + span.last, min.column, max.column);
    for (int column = firstFrom(x + span.first, min.column, max.column); column <= last; ++column) {
      visit(CellIndex{column, row});
    }
  }
}

}  // namespace datmo
