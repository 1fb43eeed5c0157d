// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/Image.h>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/display/grid_views_options.h"

namespace datmo {

/// Draws grids side by side for visual comparison: in each panel the vehicle is at the same
/// position, forward is up, and the scale is the same. Free is light, occupied dark, unknown bluish
/// gray; contradictions between sources are red in the panel `conflict`. The panel `map` is rotated
/// into the vehicle's frame by the last pose; all others are in that frame already.
///
///     |<----- panel ----->|<gap>|
///     +-------------------+     +--
///     | title             |     |      kTitleHeight
///     +-------------------+     +--
///     |         x ^       |     |
///     |     y <---+       |     |      (ahead + behind) * pixels_per_meter
///     +-------------------+     +--
///       2 to_side * pixels_per_meter
class GridViews {
 public:
  static constexpr int kTitleHeight = 24;  ///< px
  static constexpr int kGap = 4;           ///< px, between two panels

  /// Throws OptionError, for panels like GridViewsOptions::panelNames, and for a picture that is
  /// too large.
  explicit GridViews(const Checked<GridViewsOptions>& options);

  /// From left to right.
  const std::vector<std::string>& panels() const { return panels_; }

  /// Sets the newest grid of a panel. One much older than the newest of all indicates a new run of
  /// the clock: everything before is forgotten. The exception is the map, which may be of any age.
  void handleGrid(const std::string& panel, const nav_msgs::OccupancyGridConstPtr& grid);

  /// Sets the newest pose of the vehicle in the map.
  void handlePose(const geometry_msgs::PoseWithCovarianceStampedConstPtr& pose) { pose_ = pose; }

  /// Returns the panels as rgb8, with the header of the last grid. A panel without a grid is empty,
  /// and its title says why: none received, silent, or the reason why it is bad.
  sensor_msgs::ImagePtr draw() const;

 private:
  struct Panel;  ///< its position in the picture

  std::string drawGrid(const std::string& name, Panel& panel) const;
  const nav_msgs::OccupancyGrid& gridOf(const std::string& name) const;
  Pose2 baseInGrid(const std::string& name) const;

  GridViewsOptions options_;
  std::vector<std::string> panels_;
  int panel_width_;                                               ///< px
  int panel_height_;                                              ///< px, without the title
  std::map<std::string, nav_msgs::OccupancyGridConstPtr> grids_;  ///< by panel
  geometry_msgs::PoseWithCovarianceStampedConstPtr pose_;
  std_msgs::Header last_;        ///< of the last grid
  std::optional<Stamp> newest_;  ///< of all grids except the map
};

}  // namespace datmo
