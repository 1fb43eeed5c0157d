// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <datmo_fusion/SaveMap.h>
#include <tf2_msgs/TFMessage.h>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/convert/scan_conversion.h"
#include "datmo_fusion/ros/display/scan_extent.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/map_files.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/prior_map_options.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/checkpoint_keeper.h"
#include "datmo_fusion/ros/stage/frozen_sensor.h"
#include "datmo_fusion/ros/stage/held_transform.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/odometry_wait.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/stage/waiting_scans.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/slam/grid_slam.h"
#include "datmo_fusion/slam/odometry_poses.h"
#include "datmo_fusion/tracking/step_budget.h"

namespace datmo {

struct GridSlamStageOptions {
  FrameOptions frames;   ///< shared by all stages
  MotionOptions motion;  ///< shared by all stages
  bool fused_grid = false;
  double map_period = 1.0;         ///< s
  double max_tilt = degrees(5.0);  ///< rad
  double odometry_wait = 0.0;      ///< s
  StreamOptions input;
  ScanConversionOptions scan;
  PriorMapOptions prior_map;
  CheckpointOptions checkpoint;
  GridSlamOptions slam;

  void visit(OptionVisitor& visitor);
  void check() const;
  static SharedKeys sharedKeys();
};

/// Result of one scan or fused grid, ready to be published.
struct GridSlamOutput {
  LabeledScanPtr labeled_scan;
  geometry_msgs::PoseWithCovarianceStampedPtr pose;
  geometry_msgs::PoseWithCovarianceStampedPtr local_pose;  ///< without the map's drift
  LocalizationStatePtr localization;
  std::vector<geometry_msgs::TransformStamped> transforms;
};

/// Runs GridSlam on messages, for both the nodelet and the bag runner.
///
/// Bad input is dropped or warned about, with a report to the monitor, never thrown. The state is
/// reset when the clock jumps.
///
/// With `odometry_wait` a scan waits for the odometry that precedes it (OdometryWait).
///
/// With low-level fusion (`fused_grid`) scans wait for the fused grid of their stamp, which sets
/// the pace.
///
/// If the process was killed, it continues from its last checkpoint with the first scan
/// (CheckpointKeeper).
///
/// With odometry, map -> odom is chosen so that together with odom -> base_link at the scan's stamp
/// it gives the pose; odom -> base_link itself comes from the publisher of the odometry, and may be
/// ahead of the scan. It is omitted while odometry is silent. Without odometry, or with motion
/// measured by other sensors, map and odom are identical, and odom -> base_link is the pose.
class GridSlamStage : public Stage {
 public:
  using Options = GridSlamStageOptions;

  /// `transforms` and `monitor` must outlive the stage. `clock`: none: the output depends on the
  /// input alone, and there are no checkpoints. Throws OptionError, also for an unreadable prior
  /// map.
  GridSlamStage(const Checked<GridSlamStageOptions>& options, const TransformBuffer& transforms,
                StageMonitor& monitor, const StepClock& clock = {});
  /// Writes a last checkpoint.
  ~GridSlamStage() override;
  GridSlamStage(const GridSlamStage&) = delete;
  GridSlamStage& operator=(const GridSlamStage&) = delete;

  /// Sets the newest odometry, the vehicle's own or that of MotionStage (without speed if from an
  /// IMU alone); ignored if the options name no source of motion. Returns its stamp; none if it was
  /// dropped.
  std::optional<Stamp> handleOdometry(const nav_msgs::Odometry& message);

  /// `Message`: sensor_msgs::LaserScan or MultiEchoLaserScan. None if it was dropped or waits for
  /// the fused grid of its stamp.
  template <typename Message>
  std::optional<GridSlamOutput> handleScan(const Message& message);

  /// Processes the fused grid at the stamp of an earlier scan. A grid of another stamp (the scanner
  /// is silent) is used alone. None if it was dropped, also if the options have no low-level
  /// fusion.
  std::optional<GridSlamOutput> handleGrid(const nav_msgs::OccupancyGrid& message);

  /// Returns the map after the last scan, with this stamp; null if it is not due. Request it after
  /// publishing the scan's results, which other stages wait for; nothing waits for the map, and
  /// creating it may take as long as all stages need for the scan.
  nav_msgs::OccupancyGridPtr mapIfDue(Stamp stamp);

  /// Writes a checkpoint in the background, if there is a file for it. Call it after publishing the
  /// scan's results, too.
  void keepCheckpoint();

  /// Writes the map (writeMap); while the vehicle is not located, the map in which it last was.
  /// Returns a sentence about what was written. Throws MapFileError.
  std::string saveMap(const std::string& file) const;

  /// The service save_map: like saveMap, for an absolute path other than the prior map in use.
  /// Errors are returned in the response and as a warning of the monitor.
  datmo_fusion::SaveMap::Response answer(const datmo_fusion::SaveMap::Request& request) const;

  void connect(StagePorts& ports) override;
  bool publishNext(Stamp now) override { return odometry_wait_.serveNext(now); }
  double maxWait() const override { return odometry_wait_.maxWait(); }

 private:
  bool isOfPriorMap(const std::string& file) const;
  void readPriorMap();
  /// Before the first scan, which has this stamp; does nothing before later ones.
  void continueAt(Stamp stamp);
  void checkBaseFrame(const std::string& frame) const;

  void reset();
  void warnOf(const ScannerMount& mount, const ConvertedScan& converted);

  /// For diagnostics.
  void showMatch(const SlamResult& result);
  void showLocalization(const LocalizationState& state);
  void showForgottenTiles();
  GridSlamOutput finish(const SlamResult& result);
  GridSlamOutput outputOf(const SlamResult& result);
  LocalizationStatePtr localizationOf(const SlamResult& result) const;
  /// From the odometry's poses.
  std::optional<Pose2> motionBetween(Stamp from, Stamp to) const;
  /// map -> odom at the stamp of odometry received now, while scans are silent; else null.
  tf2_msgs::TFMessagePtr heldAt(Stamp stamp, Stamp now) const;
  std::vector<geometry_msgs::TransformStamped> transformsTo(const Pose2& base_in_map, Stamp stamp);

  GridSlamStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  GridSlam slam_;
  ScanExtent extent_;
  StageRunner runner_;
  OdometryReader odometry_;
  OdometryPoses odometry_poses_;
  OdometryWait odometry_wait_;
  FrozenSensor frozen_;
  WaitingScans scans_;
  HeldTransform held_;
  std::optional<Stamp> last_map_;
  std::uint64_t degenerate_scans_ = 0;
  std::uint32_t maps_started_ = 0;
  std::size_t forgotten_tiles_ = 0;
  std::unique_ptr<CheckpointKeeper> checkpoints_;  ///< null: none
};

}  // namespace datmo
