// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/convert/scan_conversion.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/frozen_sensor.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/sensor_model/lidar_grid.h"

namespace datmo {

struct LidarGridStageOptions {
  FrameOptions frames;             ///< shared by all stages
  double max_tilt = degrees(5.0);  ///< rad
  MotionOptions motion;            ///< shared by all stages
  StreamOptions input;
  ScanConversionOptions scan;
  LidarGridOptions grid;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Runs LidarGridModel on messages, for both the nodelet and the bag runner. Bad input is dropped
/// or warned about, with a report to the monitor, never thrown.
///
/// A scan is motion-compensated by odometry or, if the vehicle has none, by the poses of SLAM;
/// without either, all its beams are assumed to be measured at the stamp.
class LidarGridStage : public Stage {
 public:
  using Options = LidarGridStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  LidarGridStage(const Checked<LidarGridStageOptions>& options, const TransformBuffer& transforms,
                 StageMonitor& monitor);

  /// Sets the newest odometry; ignored if the options say that the vehicle has none.
  void handleOdometry(const nav_msgs::Odometry& message) { handleMotion(message); }

  /// Sets the newest SLAM pose; used only if the options say that the vehicle has no odometry.
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
    handleMotion(message);
  }

  /// `Message`: sensor_msgs::LaserScan or MultiEchoLaserScan. Null if it was dropped.
  template <typename Message>
  nav_msgs::OccupancyGridPtr handleScan(const Message& message);

  void connect(StagePorts& ports) override;

 private:
  template <typename Message>
  void handleMotion(const Message& message) {
    runner_.serve([&] { motion_.update(message); });
  }
  void warnOf(const ScannerMount& mount, const ConvertedScan& converted);

  LidarGridStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  LidarGridModel model_;
  StageRunner runner_;
  MotionInput motion_;
  FrozenSensor frozen_;
};

}  // namespace datmo
