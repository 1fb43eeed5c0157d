// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <tf2_msgs/TFMessage.h>

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

struct StaticPointsStageOptions {
  FrameOptions frames;  ///< of all stages
  std::string scan_frame = "static_scan";
  bool include_unknown = true;
  StreamOptions input;

  void visit(OptionVisitor& visitor);
};

/// What one labeled scan led to.
struct StaticPointsOutput {
  sensor_msgs::PointCloud2ConstPtr points;  ///< x, y, z, m, frame of the labeled scan, z = 0
  sensor_msgs::LaserScanConstPtr scan;      ///< null where the beams are not known
  tf2_msgs::TFMessageConstPtr mount;        ///< base -> scan_frame; null if it has not changed
};

/// What stands still around the vehicle, for a navigation stack: the labeled scan without what
/// moves, as a cloud and as a planar scan (staticRanges). Bad input is dropped through the monitor,
/// never thrown.
class StaticPointsStage : public Stage {
 public:
  using Options = StaticPointsStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  StaticPointsStage(const Checked<StaticPointsStageOptions>& options, StageMonitor& monitor);

  /// None if the scan was dropped.
  std::optional<StaticPointsOutput> takeLabeledScan(const LabeledScanMessage& message);

  void connect(StagePorts& ports) override;

 private:
  tf2_msgs::TFMessageConstPtr newMount(const LabeledScan& scan, const std_msgs::Header& header);

  StaticPointsStageOptions options_;
  StageMonitor& monitor_;
  StageRunner runner_;
  std::optional<Pose2> mount_;  ///< of the scanner in the vehicle's frame, that was put out last
};

}  // namespace datmo
