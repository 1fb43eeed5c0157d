// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/stage/stereo_input.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/sensor_model/stereo_grid.h"

namespace datmo {

struct StereoGridStageOptions : StereoInputOptions {
  double scanner_height = 0.33;  ///< m
  StereoGridOptions grid;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Runs StereoGridModel on messages, for both the nodelet and the bag runner. Bad input is dropped
/// or warned about, with a report to the monitor, never thrown. When the clock jumps the road
/// of the last clouds is forgotten.
class StereoGridStage : public Stage {
 public:
  using Options = StereoGridStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  StereoGridStage(const Checked<StereoGridStageOptions>& options, const TransformBuffer& transforms,
                  StageMonitor& monitor);

  /// Of the right camera; the newest one is used.
  void handleCameraInfo(const sensor_msgs::CameraInfo& message);

  /// Sets the alignment; the newest one is used.
  void handleAlignment(const StereoAlignmentMessage& message);

  /// Null if the cloud was dropped.
  nav_msgs::OccupancyGridPtr handleCloud(const sensor_msgs::PointCloud2& message);

  void connect(StagePorts& ports) override;

 private:
  /// Throws InputError (`bad_camera`) for a camera that cannot see the road from its mount.
  StereoGridResult gridOf(const StereoCloud& cloud);

  /// Above base_link's origin, m.
  double scannerHeight();
  void show(const StereoGridResult& result);

  StereoGridStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  StageRunner runner_;
  StereoInput input_;
  StereoGridModel model_;
};

}  // namespace datmo
