#include "datmo_fusion/fusion/grid_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace datmo {

namespace {

/// The slots of a grid's cells by place, without a branch for each border.
class Slots {
 public:
  explicit Slots(const GridWindow& window) : window_(window) {}

  static constexpr std::size_t kOutside = static_cast<std::size_t>(-1);

  /// `place`: in cells from the window's lower left corner. Also outside: what is not a number.
  std::size_t at(const Point2& place) const {
    const bool inside = place.x() >= 0.0 && place.x() < window_.columns && place.y() >= 0.0 &&
                        place.y() < window_.rows;
    return inside ? static_cast<std::size_t>(place.y()) * columns() +
                        static_cast<std::size_t>(place.x())
                  : kOutside;
  }
  std::size_t columns() const { return static_cast<std::size_t>(window_.columns); }

 private:
  GridWindow window_;
};

/// A motion of the base frame, in cells from the window's lower left corner.
class MotionInCells {
 public:
  MotionInCells(const Pose2& motion, const GridWindow& window)
      : rotation_(motion.rotation()),
        first_((motion * window.centreOf(window.corner) - window.origin()) / window.cell_size) {}

  /// Where the centre of a cell comes to; `column` and `row` from the window's corner.
  Point2 place(double column, double row) const {
    return first_ + column * rotation_.col(0) + row * rotation_.col(1);
  }

 private:
  Eigen::Matrix2d rotation_;
  Point2 first_;
};

/// Each cell of `moved` takes what was known of its place; `taken`: slots of the old grid that were
/// asked.
void pull(const SensorGrid& grid, const Pose2& new_base_in_old, SensorGrid& moved,
          std::vector<char>& taken) {
  const GridWindow& window = grid.window();
  const Slots slots(window);
  const MotionInCells motion(new_base_in_old, window);
  std::size_t target = 0;
  for (int row = 0; row < window.rows; ++row) {
    for (int column = 0; column < window.columns; ++column, ++target) {
      const std::size_t source = slots.at(motion.place(column, row));
      if (source != Slots::kOutside) {
        moved.cells()[target] = grid.cells()[source];
        taken[source] = 1;
      }
    }
  }
}

/// Occupied cells that no new cell's centre came to lie in go where their own centre comes to.
void pushOccupied(const SensorGrid& grid, const Pose2& old_base_in_new,
                  const std::vector<char>& taken, SensorGrid& moved) {
  const GridWindow& window = grid.window();
  const Slots slots(window);
  const MotionInCells motion(old_base_in_new, window);
  for (std::size_t source = 0; source < taken.size(); ++source) {
    if (taken[source] != 0 || !isOccupied(grid.cells()[source])) {
      continue;
    }
    const std::size_t column = source % slots.columns();
    const std::size_t row = source / slots.columns();
    const std::size_t target =
        slots.at(motion.place(static_cast<double>(column), static_cast<double>(row)));
    if (target != Slots::kOutside) {
      Percent& cell = moved.cells()[target];
      cell = std::max(cell, grid.cells()[source]);
    }
  }
}

/// Where in each row the discs around occupied cells begin (+1) and end (-1): one column more than
/// the grid has. Sums along a row tell how many discs cover a cell, whatever their radius.
std::vector<int> discEdges(const SensorGrid& grid, double radius) {
  const GridWindow& window = grid.window();
  const int columns = window.columns;
  const int reach = static_cast<int>(std::min<double>(radius, window.rows));
  std::vector<int> half_widths;  // by row from the disc's centre
  for (int row = 0; row <= reach; ++row) {
    const double half = std::sqrt(radius * radius - static_cast<double>(row) * row);
    half_widths.push_back(static_cast<int>(std::min<double>(half, columns)));
  }
  std::vector<int> edges((static_cast<std::size_t>(columns) + 1) *
                         static_cast<std::size_t>(window.rows));
  grid.forEach([&](CellIndex cell, Percent percent) {
    if (!isOccupied(percent)) {
      return;
    }
    const int column = cell.column - window.corner.column;
    const int row = cell.row - window.corner.row;
    for (int y = std::max(0, row - reach); y <= std::min(window.rows - 1, row + reach); ++y) {
      const int half = half_widths[static_cast<std::size_t>(std::abs(y - row))];
      int* line = edges.data() + static_cast<std::ptrdiff_t>(y) * (columns + 1);
      ++line[std::max(0, column - half)];
      --line[std::min(columns, column + half + 1)];
    }
  });
  return edges;
}

/// `radius`: cells.
void forgetFreeAroundOccupied(SensorGrid& grid, double radius) {
  const std::vector<int> edges = discEdges(grid, radius);
  const int columns = grid.window().columns;
  std::size_t edge = 0;
  std::size_t slot = 0;
  for (int row = 0; row < grid.window().rows; ++row, ++edge) {
    int discs = 0;
    for (int column = 0; column < columns; ++column, ++slot) {
      discs += edges[edge++];
      Percent& cell = grid.cells()[slot];
      cell = discs > 0 && isFree(cell) ? kUnknownPercent : cell;
    }
  }
}

}  // namespace

SensorGrid movedGrid(const SensorGrid& grid, Stamp stamp, const Pose2& old_base_in_new,
                     double mover_way) {
  SensorGrid moved(stamp, grid.window());
  std::vector<char> taken(grid.cells().size());
  pull(grid, old_base_in_new.inverse(), moved, taken);
  pushOccupied(grid, old_base_in_new, taken, moved);
  if (mover_way >= grid.window().cell_size) {
    forgetFreeAroundOccupied(moved, mover_way / grid.window().cell_size);
  }
  return moved;
}

}  // namespace datmo
