// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/grid_conversion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "message_parts.h"

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

/// Cell sizes (m) outside this range belong to no grid around a vehicle.
constexpr double kMinCellSize = 1e-3;
constexpr double kMaxCellSize = 100.0;

constexpr double kMicrometersPerMeter = 1e6;
constexpr Percent kMaxPercent = 100;

/// Tolerance for rounding, in cells, or in rad for a rotation.
constexpr double kLatticeTolerance = 1e-2;
constexpr double kTurnTolerance = 1e-6;

template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw InputError("bad_grid", text.str());
}

double cellSize(float resolution) {
  // Comparisons with NaN are false.
  if (!(resolution >= kMinCellSize && resolution <= kMaxCellSize)) {
    refuse("grid with cells of ", resolution, " m: expected ", kMinCellSize, " to ", kMaxCellSize,
           " m");
  }
  return std::round(static_cast<double>(resolution) * kMicrometersPerMeter) / kMicrometersPerMeter;
}

/// The cell with its lower left corner at the origin.
CellIndex cornerAt(const Pose2& origin, double cell_size) {
  const double column = std::round(origin.x() / cell_size);
  const double row = std::round(origin.y() / cell_size);
  if (std::max(std::abs(column), std::abs(row)) > GridWindow::kMaxCell) {
    refuse("grid with its origin at ", origin.x(), ", ", origin.y(), " m: expected it at most ",
           GridWindow::kMaxCell, " cells of ", cell_size, " m from the vehicle");
  }
  const double off =
      std::max(std::abs(column * cell_size - origin.x()), std::abs(row * cell_size - origin.y()));
  if (off > kLatticeTolerance * cell_size || std::abs(origin.heading()) > kTurnTolerance) {
    refuse("grid with its origin at ", origin.x(), ", ", origin.y(), " m, rotated by ",
           origin.heading(), " rad: expected a whole number of cells of ", cell_size,
           " m along x and y, and no rotation");
  }
  return {static_cast<int>(column), static_cast<int>(row)};
}

GridWindow windowOf(const nav_msgs::OccupancyGrid& message) {
  const auto& info = message.info;
  const std::uint64_t cells = std::uint64_t{info.width} * info.height;
  if (cells == 0 || cells != message.data.size()) {
    refuse("grid of ", info.width, " x ", info.height, " cells with ", message.data.size(),
           " values: expected one for each cell, and at least one");
  }
  if (std::max(info.width, info.height) > GridWindow::kMaxCell) {
    refuse("grid of ", info.width, " x ", info.height, " cells: expected at most ",
           GridWindow::kMaxCell, " in a row");
  }
  const double cell_size = cellSize(info.resolution);
  return {cell_size, static_cast<int>(info.width), static_cast<int>(info.height),
          cornerAt(fromMessage(info.origin), cell_size)};
}

/// `cells`: at least one.
void checkValues(const std::vector<Percent>& cells) {
  const auto [min, max] = std::minmax_element(cells.begin(), cells.end());
  if (*min < kUnknownPercent || *max > kMaxPercent) {
    refuse("grid with cells from ", int{*min}, " to ", int{*max},
           ": expected -1 (unknown) or 0 to 100 percent");
  }
}

}  // namespace

nav_msgs::OccupancyGrid toMessage(SensorGrid grid, const std::string& base_frame) {
  const GridWindow& window = grid.window();
  nav_msgs::OccupancyGrid message;
  message.header = header(grid.stamp(), base_frame);
  message.info.map_load_time = message.header.stamp;
  message.info.resolution = static_cast<float>(window.cell_size);
  message.info.width = static_cast<std::uint32_t>(window.columns);
  message.info.height = static_cast<std::uint32_t>(window.rows);
  message.info.origin = toMessage(Pose2(window.origin(), 0.0));
  message.data = std::move(grid.cells());
  return message;
}

SensorGrid fromMessage(const nav_msgs::OccupancyGrid& message) {
  SensorGrid grid(toStamp(message.header.stamp), windowOf(message));
  checkValues(message.data);
  grid.cells() = message.data;
  return grid;
}

}  // namespace datmo
