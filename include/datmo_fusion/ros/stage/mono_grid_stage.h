// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/convert/scan_conversion.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/camera_input.h"
#include "datmo_fusion/ros/stage/exposure_check.h"
#include "datmo_fusion/ros/stage/image_wait.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/vision/mono_grid.h"

namespace datmo {

struct MonoGridStageOptions {
  FrameOptions frames;             ///< shared by all stages
  double max_tilt = degrees(5.0);  ///< rad
  MotionOptions motion;            ///< shared by all stages
  double tolerance = 0.06;         ///< s
  double max_wait = 0.1;           ///< s
  ExposureCheckOptions exposure;
  StreamOptions input;
  ScanConversionOptions scan;
  MonoGridOptions grid;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Runs MonoGridModel on messages, as one more source of grids, for both the nodelet and the bag
/// runner.
///
/// An image waits for the scan of its time (`tolerance`), which is motion-compensated and moved to
/// the exposure; the grid has the exposure's stamp.
///
/// Bad input is dropped or warned about, with a report to the monitor, never thrown: what
/// CameraInput, ExposureCheck and toScan reject, `no_scan` (none of the image's time came within
/// `max_wait`, or the image is older than the scans), `no_motion`, `superseded_image`,
/// `missing_transform`. The road's colors are forgotten when the clock jumps.
class MonoGridStage : public Stage {
 public:
  using Options = MonoGridStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  MonoGridStage(const Checked<MonoGridStageOptions>& options, const TransformBuffer& transforms,
                StageMonitor& monitor);

  /// Of the rectified images; the newest one is used.
  void handleCameraInfo(const sensor_msgs::CameraInfo& message);
  void handleOdometry(const nav_msgs::Odometry& message) { handleMotion(message); }
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
    handleMotion(message);
  }

  /// `Message`: sensor_msgs::LaserScan or MultiEchoLaserScan.
  template <typename Message>
  void handleScan(const Message& message);

  /// `now`: ROS time.
  void handleImage(const sensor_msgs::ImageConstPtr& message, Stamp now);

  /// Returns the grid of the waiting image, at its exposure's stamp; null if there is none. Call it
  /// after each input and periodically. `now`: ROS time.
  nav_msgs::OccupancyGridPtr next(Stamp now);

  void connect(StagePorts& ports) override;
  bool publishNext(Stamp now) override;
  double maxWait() const override { return options_.max_wait; }

 private:
  struct MountedScan {
    Scan scan;
    double height = 0.0;  ///< m, of the scanner
  };

  template <typename Message>
  void handleMotion(const Message& message) {
    runner_.serve([&] { motion_.update(message); });
  }
  void warnOf(const ScannerMount& mount, const ConvertedScan& converted);
  MountedScan scanOf(Stamp exposure) const;
  nav_msgs::OccupancyGridPtr gridOf(const sensor_msgs::ImageConstPtr& image);
  void reset();

  MonoGridStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  StageRunner runner_;
  MotionInput motion_;
  CameraInput camera_;
  ExposureCheck exposure_;
  MonoGridModel model_;
  ImageWait<MountedScan> wait_;
  StagePublisher<nav_msgs::OccupancyGrid> published_;
};

}  // namespace datmo
