// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/fusion/map/map_fuser.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/stage/fusion_inputs.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

struct MapFusionStageOptions {
  FrameOptions frames;   ///< shared by all stages
  MotionOptions motion;  ///< shared by all stages
  StreamOptions input;
  double period = 1.0;     ///< s
  double tolerance = 0.1;  ///< s
  double max_wait = 0.1;   ///< s
  std::string prior_map;   ///< file; empty: none
  MapFuserOptions fuser;

  void visit(OptionVisitor& visitor);
};

/// The maps, ready to be published; null while they are not due; `changes` also without a prior
/// map.
struct MapFusionOutput {
  nav_msgs::OccupancyGridPtr fused;
  nav_msgs::OccupancyGridPtr conflicts;
  nav_msgs::OccupancyGridPtr changes;
};

/// Runs MapFuser on messages, for both the nodelet and the bag runner. Instantaneous grids wait for
/// the labeled scan closest to their stamp, which has the pose and the moving points
/// (SourceMatcher); each is integrated once, with the pose at its own stamp. FusionInputs decides
/// what is accepted and reports missing sources. When the clock jumps everything except the
/// prior map is forgotten.
class MapFusionStage : public Stage {
 public:
  using Options = MapFusionStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  MapFusionStage(const Checked<MapFusionStageOptions>& options, StageMonitor& monitor);

  /// The sources in use, by name.
  std::vector<std::string> sources() const { return options_.fuser.sourcesInUse(); }

  /// Adds a grid of a source (else it is dropped: `unknown_source`), with the first one's window
  /// (else `wrong_window`). `now`: ROS time.
  void handleGrid(const std::string& source, const nav_msgs::OccupancyGrid& message, Stamp now);

  /// Sets the pose and the moving points.
  void handleLabeledScan(const LabeledScanMessage& message, Stamp now);

  /// Sets the newest odometry; ignored if the options say that the vehicle has none.
  void handleOdometry(const nav_msgs::Odometry& message) { inputs_.handleMotion(message); }

  /// Sets the newest SLAM pose; used only if the options say that the vehicle has no odometry.
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
    inputs_.handleMotion(message);
  }

  /// Integrates the next set of grids that is ready; none if there is none. Call it until it
  /// returns none, after each message and periodically. `now`: ROS time.
  std::optional<MapFusionOutput> next(Stamp now);

  void connect(StagePorts& ports) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override { return options_.max_wait; }

 private:
  /// Samples that the matcher aligns in time.
  using Sample = std::variant<SensorGrid, LabeledScan>;
  using Matched = MatchedSamples<Sample>;

  void checkWindow(const std::string& source, const GridWindow& window);
  void readPriorMap(const GridWindow& window);
  MapFusionOutput fuse(const Matched& matched);

  /// Integrates the grids of a set; returns the missing and unusable ones.
  std::vector<MissingSource> ingest(const Matched& matched, const LabeledScan& scan);
  MapFusionOutput outputAt(Stamp stamp);
  void show(const FusedMaps& maps);
  void reset();

  MapFusionStageOptions options_;
  StageMonitor& monitor_;
  StageRunner runner_;
  FusionInputs inputs_;
  SourceMatcher<Sample> matcher_;
  MapFuser fuser_;
  std::optional<GridWindow> window_;  ///< of the first grid
  std::optional<Stamp> last_pose_;
  std::uint64_t left_out_ = 0;  ///< scans whose pose was too uncertain
  std::optional<Stamp> last_output_;
  StagePublisher<nav_msgs::OccupancyGrid> fused_;
  StagePublisher<nav_msgs::OccupancyGrid> conflicts_;
  StagePublisher<nav_msgs::OccupancyGrid> changes_;
};

}  // namespace datmo
