// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/convert/lidar_cloud_conversion.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/sensor_model/cloud_to_scan.h"

namespace datmo {

struct CloudToScanStageOptions {
  FrameOptions frames;  ///< shared by all stages
  std::string scan_frame = "cloud_scan";
  double max_sweep = 0.25;  ///< s
  StreamOptions input;
  CloudToScanOptions scan;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Result for one cloud.
struct CloudToScanOutput {
  sensor_msgs::LaserScanPtr scan;
  /// base -> the scan's frame, if it has changed since the last output: it lies below (or above)
  /// the lidar, at the height of the middle of the band, with the axes of base.
  std::optional<geometry_msgs::TransformStamped> mount;
};

/// Runs CloudToScan on messages, for both the nodelet and the bag runner. Bad input is dropped or
/// warned about, with a report to the monitor, never thrown.
class CloudToScanStage : public Stage {
 public:
  using Options = CloudToScanStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  CloudToScanStage(const Checked<CloudToScanStageOptions>& options,
                   const TransformBuffer& transforms, StageMonitor& monitor);

  /// Converts a cloud of a 3D lidar whose frame is in tf. None if the cloud was dropped.
  std::optional<CloudToScanOutput> handleCloud(const sensor_msgs::PointCloud2& message);

  void connect(StagePorts& ports) override;

 private:
  void warnOf(const ConvertedCloud& converted, const PlanarScan& scan);
  void show(const ConvertedCloud& converted, const PlanarScan& scan);
  sensor_msgs::LaserScanPtr toMessage(const PlanarScan& scan, const ros::Time& stamp) const;
  std::optional<geometry_msgs::TransformStamped> newMount(const Eigen::Isometry3d& lidar_in_base,
                                                          const ros::Time& stamp);

  CloudToScanStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  CloudToScan model_;
  StageRunner runner_;
  std::optional<Eigen::Vector3d> mount_;  ///< m, of the last output
};

}  // namespace datmo
