// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/fusion/grid/grid_fuser.h"
#include "datmo_fusion/fusion/grid/grid_matcher.h"
#include "datmo_fusion/ros/stage/fusion_inputs.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

struct GridFusionStageOptions {
  FrameOptions frames;   ///< shared by all stages
  MotionOptions motion;  ///< shared by all stages
  StreamOptions input;
  SourceMatcherOptions matcher;
  GridFuserOptions fuser;

  void visit(OptionVisitor& visitor);
};

/// Result of one set of grids, ready to be published.
struct GridFusionOutput {
  nav_msgs::OccupancyGridPtr fused;
  nav_msgs::OccupancyGridPtr conflict;
};

/// Runs GridMatcher and GridFuser on messages, for both the nodelet and the bag runner.
/// FusionInputs decides what is accepted and reports missing sources. The state is reset when the
/// clock jumps.
class GridFusionStage : public Stage {
 public:
  using Options = GridFusionStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  GridFusionStage(const Checked<GridFusionStageOptions>& options, StageMonitor& monitor);

  /// The sources in use, by name.
  std::vector<std::string> sources() const { return options_.fuser.sourcesInUse(); }

  /// Adds a grid of a source (else it is dropped: `unknown_source`). `now`: ROS time.
  void handleGrid(const std::string& source, const nav_msgs::OccupancyGrid& message, Stamp now);

  /// Sets the newest odometry; ignored if the options say that the vehicle has none.
  void handleOdometry(const nav_msgs::Odometry& message) { inputs_.handleMotion(message); }

  /// Sets the newest SLAM pose; used only if the options say that the vehicle has no odometry.
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
    inputs_.handleMotion(message);
  }

  /// Fuses the next set of grids that is ready; none if there is none. Call it until it returns
  /// none, after each grid and periodically, because a set may become ready by timeout. `now`: ROS
  /// time.
  std::optional<GridFusionOutput> next(Stamp now);

  void connect(StagePorts& ports) override;
  std::vector<LiveOption> live() const override { return liveOptions(options_); }
  void change(const OptionValues& values) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override { return options_.matcher.max_wait; }

 private:
  GridFusionOutput fuse(const MatchedGrids& matched);
  void reset();

  GridFusionStageOptions options_;
  StageRunner runner_;
  FusionInputs inputs_;
  GridMatcher matcher_;
  GridFuser fuser_;
  StagePublisher<nav_msgs::OccupancyGrid> fused_;
  StagePublisher<nav_msgs::OccupancyGrid> conflict_;
};

}  // namespace datmo
