// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/detection/cloud_object_detector.h"
#include "datmo_fusion/ros/convert/lidar_cloud_conversion.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

struct CloudObjectsStageOptions {
  FrameOptions frames;      ///< of all stages
  MotionOptions motion;     ///< of all stages
  double max_sweep = 0.25;  ///< s
  StreamOptions input;
  CloudObjectDetectorOptions detector;

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// CloudObjectDetector between messages: one more source of objects. Bad input is dropped or warned
/// of through the monitor, never thrown. Points that have times are brought to the cloud's stamp by
/// odometry, where the vehicle has none by the poses of the SLAM; where neither has come, all are
/// taken as measured at once.
class CloudObjectsStage : public Stage {
 public:
  using Options = CloudObjectsStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  CloudObjectsStage(const Checked<CloudObjectsStageOptions>& options,
                    const TransformBuffer& transforms, StageMonitor& monitor);

  void takeOdometry(const nav_msgs::Odometry& message) { takeMotion(message); }
  void takePose(const geometry_msgs::PoseWithCovarianceStamped& message) { takeMotion(message); }

  /// Objects in the vehicle's frame at the cloud's stamp; null if the cloud was dropped.
  ObjectArrayPtr takeCloud(const sensor_msgs::PointCloud2& message);

  void connect(StagePorts& ports) override;

 private:
  template <typename Message>
  void takeMotion(const Message& message) {
    runner_.serve([&] { motion_.take(message); });
  }

  /// Of the vehicle during the sweep; none if the points have no times, or it is not known.
  std::optional<Twist2> twistDuring(const ConvertedCloud& converted, Stamp stamp) const;
  void show(const CloudObjects& objects, const ConvertedCloud& converted);

  CloudObjectsStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  CloudObjectDetector detector_;
  StageRunner runner_;
  MotionInput motion_;
};

}  // namespace datmo
