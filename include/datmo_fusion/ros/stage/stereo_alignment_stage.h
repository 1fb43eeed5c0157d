// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <set>
#include <vector>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/convert/scan_conversion.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/frozen_sensor.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/stage/stereo_input.h"
#include "datmo_fusion/sensor_model/stereo_alignment.h"
#include "datmo_fusion/sensor_model/surface_pairs.h"

namespace datmo {

struct StereoAlignmentStageOptions : StereoInputOptions {
  MotionOptions motion;  ///< shared by all stages
  ScanConversionOptions scan;
  StereoAlignmentOptions alignment;
  SurfacePairOptions pairs;
  double max_interval = 0.25;  ///< s

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Estimates the alignment of a stereo camera's clouds with the scans (StereoAlignmentFilter), for
/// the stages that use the clouds, and for people: diagnostics warn of unusual values. Used by both
/// the nodelet and the bag runner. Bad input is dropped and reported to the monitor, never thrown.
/// Cameras that do not measure disparities are not compared. When the clock jumps the scans
/// are forgotten, but not the alignment, which is a property of the sensors.
class StereoAlignmentStage : public Stage {
 public:
  using Options = StereoAlignmentStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  StereoAlignmentStage(const Checked<StereoAlignmentStageOptions>& options,
                       const TransformBuffer& transforms, StageMonitor& monitor);

  void handleOdometry(const nav_msgs::Odometry& message);
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// `Message`: sensor_msgs::LaserScan or MultiEchoLaserScan.
  template <typename Message>
  void handleScan(const Message& message);

  /// Of the right camera; the newest one is used.
  void handleCameraInfo(const sensor_msgs::CameraInfo& message);

  /// Null if the cloud was dropped, or no scan is close enough in time.
  StereoAlignmentMessagePtr handleCloud(const sensor_msgs::PointCloud2& message);

  void connect(StagePorts& ports) override;

 private:
  void reset();
  /// The scan nearest in time, in the vehicle's frame at `stamp`.
  std::optional<std::vector<Ray>> raysAt(Stamp stamp) const;
  Scan compensated(const Scan& scan) const;
  Twist2 twistAt(Stamp stamp) const;
  StereoAlignmentMessagePtr compare(const StereoCloud& cloud, const std::vector<Ray>& rays);
  void show();

  StereoAlignmentStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  StageRunner runner_;
  MotionInput motion_;
  StereoInput input_;
  SurfacePairFinder finder_;
  StereoAlignmentFilter filter_;
  std::deque<Scan> scans_;  ///< the most recent ones
  FrozenSensor frozen_;
  bool was_usable_ = true;
  std::set<AlignmentTerm> faults_;  ///< already warned about
};

}  // namespace datmo
