// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/shared_keys.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/stage/stamp_check.h"
#include "datmo_fusion/ros/stage/stereo_pairs.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/vision/camera_motion.h"
#include "datmo_fusion/vision/point_velocity.h"
#include "datmo_fusion/vision/quad_matcher.h"

namespace datmo {

struct PointVelocityStageOptions {
  FrameOptions frames;   ///< shared by all stages
  MotionOptions motion;  ///< shared by all stages
  StreamOptions input;
  QuadMatcherOptions features;
  CameraMotionOptions camera_motion;
  StereoSyncOptions sync;
  bool rectified = true;
  double flow_sigma = 0.15;       ///< px
  double disparity_sigma = 0.15;  ///< px
  double turn_sigma = 0.05;       ///< rad/s
  double speed_sigma = 0.5;       ///< m/s
  double max_interval = 0.5;      ///< s

  void visit(OptionVisitor& visitor);
  static SharedKeys sharedKeys();
};

/// Computes points with velocity over ground from image pairs of a stereo camera: features matched
/// between two pairs (QuadMatcher), compensated for the camera's own motion (cameraMotion, with
/// odometry as prior). Used by both the nodelet and the bag runner. Bad input is dropped and
/// reported to the monitor, never thrown. The last images are forgotten when the clock jumps.
class PointVelocityStage : public Stage {
 public:
  using Options = PointVelocityStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  PointVelocityStage(const Checked<PointVelocityStageOptions>& options,
                     const TransformBuffer& transforms, StageMonitor& monitor);

  void handleOdometry(const nav_msgs::Odometry& message);
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// Returns points in the vehicle's frame at the left image's stamp (velocity_conversion.h), for
  /// the pair that the message completes; null if it completes none, or the pair was dropped. The
  /// first pair yields no points.
  sensor_msgs::PointCloud2Ptr handleImage(StereoSide side, const sensor_msgs::ImageConstPtr& image);
  sensor_msgs::PointCloud2Ptr handleInfo(StereoSide side,
                                         const sensor_msgs::CameraInfoConstPtr& info);

  void connect(StagePorts& ports) override;

 private:
  struct LastPair {
    Stamp stamp;
    Eigen::Isometry3d camera_in_base;
  };

  void reset();
  sensor_msgs::PointCloud2Ptr serve(const std::optional<StereoPair>& pair);
  std::vector<PointVelocity> velocitiesOf(const StereoPair& pair);
  /// From odometry; without it, standing still with the uncertainty of a vehicle's usual motion.
  CameraMotion priorSince(const LastPair& last, const LastPair& now) const;

  PointVelocityStageOptions options_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  StageRunner runner_;
  MotionInput motion_;
  StereoPairs pairs_;
  std::uint64_t unpaired_ = 0;  ///< number of frames reported
  QuadMatcher matcher_;
  std::optional<LastPair> last_;
};

}  // namespace datmo
