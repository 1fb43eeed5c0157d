// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "message_samples.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/stage/grid_fusion_stage.h"

namespace datmo::grid_fusion_samples {

inline constexpr Percent kOccupied = 80;
inline constexpr Percent kFree = 20;

/// Two rows of ten cells of 1 m, the vehicle at the left.
inline const GridWindow kWindow{1.0, 10, 2, {0, -1}};

class GridFusionStageTest : public testing::Test {
 protected:
  static nav_msgs::OccupancyGrid message(double seconds, Percent percent,
                                         const GridWindow& window = kWindow) {
    SensorGrid grid(Stamp::fromSeconds(seconds), window);
    std::fill(grid.cells().begin(), grid.cells().end(), percent);
    return toMessage(grid, "base_link");
  }

  void handle(const std::string& source, double seconds, Percent percent) {
    handle(source, message(seconds, percent));
  }

  void handle(const std::string& source, const nav_msgs::OccupancyGrid& grid) {
    stage_.handleGrid(source, grid, toStamp(grid.header.stamp));
  }

  std::optional<GridFusionOutput> nextAt(double seconds) {
    return stage_.next(Stamp::fromSeconds(seconds));
  }

  /// Adds both sources at this time, and fuses them.
  std::optional<GridFusionOutput> bothAt(double seconds, Percent lidar, Percent stereo) {
    handle("lidar", seconds, lidar);
    handle("stereo", seconds, stereo);
    return nextAt(seconds);
  }

  std::uint64_t drops(const std::string& reason) const { return samples::drops(monitor_, reason); }
  std::uint64_t warnings(const std::string& reason) const {
    return samples::warnings(monitor_, reason);
  }

  StageMonitor monitor_{"grid_fusion"};
  GridFusionStageOptions options_;
  GridFusionStage stage_{options_, monitor_};
};

inline nav_msgs::Odometry odometry(double seconds) { return samples::odometry(seconds, 20.0); }

}  // namespace datmo::grid_fusion_samples
