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
  FrameOptions frames;  ///< shared by all stages
  std::string scan_frame = "static_scan";
  bool include_unknown = true;
  StreamOptions input;

  void visit(OptionVisitor& visitor);
};

/// Result of one labeled scan.
struct StaticPointsOutput {
  sensor_msgs::PointCloud2ConstPtr points;  ///< x, y, z, m, frame of the labeled scan, z = 0
  sensor_msgs::LaserScanConstPtr scan;      ///< null if the beams are unknown
  tf2_msgs::TFMessageConstPtr mount;        ///< base -> scan_frame; null if it has not changed
};

/// Publishes the static surroundings of the vehicle for a navigation stack: the labeled scan
/// without moving points, as a cloud and as a planar scan (staticRanges). Bad input is dropped and
/// reported to the monitor, never thrown.
class StaticPointsStage : public Stage {
 public:
  using Options = StaticPointsStageOptions;

  /// `monitor` must outlive the stage. Throws OptionError.
  StaticPointsStage(const Checked<StaticPointsStageOptions>& options, StageMonitor& monitor);

  /// None if the scan was dropped.
  std::optional<StaticPointsOutput> handleLabeledScan(const LabeledScanMessage& message);

  void connect(StagePorts& ports) override;

 private:
  tf2_msgs::TFMessageConstPtr newMount(const LabeledScan& scan, const std_msgs::Header& header);

  StaticPointsStageOptions options_;
  StageMonitor& monitor_;
  StageRunner runner_;
  std::optional<Pose2> mount_;  ///< last published pose of the scanner in the vehicle's frame
};

}  // namespace datmo
