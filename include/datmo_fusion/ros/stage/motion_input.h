// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo {

/// Throws InputError (`wrong_frame`) unless the odometry is of the vehicle, in its frame for that.
void checkFrames(const nav_msgs::Odometry& message, const FrameOptions& frames);

/// What the options take of odometry: with odometry_pose its pose, too, and then a twist that no
/// vehicle has (the mean over a gap of clocks, say) is left out and warned of (`bad_twist`): the
/// pose is what counts. Throws InputError (`bad_odometry`, `bad_pose`).
OdometrySample readOdometry(const nav_msgs::Odometry& message, const MotionOptions& options,
                            StageMonitor& monitor);

/// The motion of the vehicle between two stamps, as its odometry measures it; where its speed is
/// not measured, as the poses of the SLAM do.
class MotionInput {
 public:
  /// `runner`: of the stage, which is to call reset() when it is reset itself; it must outlive the
  /// input. Throws OptionError.
  MotionInput(const Checked<MotionOptions>& options, FrameOptions frames, StageRunner& runner);

  /// Not read where the speed is not measured. Throws InputError (`wrong_frame`, `bad_odometry`,
  /// `bad_pose`, and those of StageRunner::check).
  void take(const nav_msgs::Odometry& message);

  /// The same for the vehicle's pose in a frame that does not move; read only where its speed
  /// is not measured. Throws InputError (`bad_pose`, `pose_jump`, and those of StageRunner::check).
  void take(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// From one stamp to a later one; none if it is not known (OdometryBuffer::motion).
  std::optional<Pose2> between(Stamp from, Stamp to) const { return buffer_.motion(from, to); }

  /// Forgets everything.
  void reset();

 private:
  struct StampedPose {
    Stamp stamp;
    Pose2 pose;
  };

  MotionOptions options_;
  FrameOptions frames_;
  StageRunner& runner_;
  OdometryBuffer buffer_;
  std::optional<StampedPose> last_pose_;  ///< of the SLAM
};

}  // namespace datmo
