// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/detection/cloud_object_detector.h"
#include "datmo_fusion/ros/convert/lidar_cloud_conversion.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/object_source.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

struct CloudObjectsStageOptions {
  FrameOptions frames;      ///< shared by all stages
  MotionOptions motion;     ///< shared by all stages
  double max_sweep = 0.25;  ///< s
  StreamOptions input;
  CloudObjectDetectorOptions detector;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Runs CloudObjectDetector on messages. Points with times are motion-compensated to the cloud's
/// stamp by odometry or, if the vehicle has none, by the poses of SLAM; without either, all are
/// assumed to be measured at the stamp.
class CloudObjectsStage : public ObjectSource<sensor_msgs::PointCloud2> {
 public:
  using Options = CloudObjectsStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  CloudObjectsStage(const Checked<CloudObjectsStageOptions>& options,
                    const TransformBuffer& transforms, StageMonitor& monitor);

 private:
  ObjectList detect(const sensor_msgs::PointCloud2& message) override;
  /// The vehicle's twist during the sweep; none if the points have no times, or it is unknown.
  std::optional<Twist2> twistDuring(const ConvertedCloud& converted, Stamp stamp) const;
  void show(const CloudObjects& objects, const ConvertedCloud& converted);

  CloudObjectsStageOptions options_;
  CloudObjectDetector detector_;
};

}  // namespace datmo
