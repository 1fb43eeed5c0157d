#pragma once

#include <optional>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/stamp_check.h"
#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo {

/// Throws InputError (`wrong_frame`) unless the odometry is of the vehicle, in its frame for that.
void checkFrames(const nav_msgs::Odometry& message, const FrameOptions& frames);

/// The motion of the vehicle between two stamps, as its odometry measures it; where its speed is
/// not measured, as the poses of the SLAM do.
class MotionInput {
 public:
  /// Throws OptionError.
  MotionInput(const MotionOptions& options, FrameOptions frames, double restart_after);

  /// kRestart: the clock jumped back, and all that was there before is forgotten. Not read where
  /// the speed is not measured. Throws InputError (`wrong_frame`, `bad_odometry`, `bad_pose`, and
  /// those of StampCheck).
  Arrival take(const nav_msgs::Odometry& message);

  /// The same for the vehicle's pose in a frame that does not move; read only where its speed
  /// is not measured. Throws InputError (`bad_pose`, `pose_jump`, and those of StampCheck).
  Arrival take(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// From one stamp to a later one; none if it is not known (OdometryBuffer::motion).
  std::optional<Pose2> between(Stamp from, Stamp to) const { return buffer_.motion(from, to); }

  /// Forgets everything: the clock of another input has jumped back.
  void reset();

 private:
  struct StampedPose {
    Stamp stamp;
    Pose2 pose;
  };

  /// Throws InputError.
  Arrival checkStamp(const ros::Time& stamp);

  MotionOptions options_;
  FrameOptions frames_;
  double restart_after_;
  StampCheck stamps_;
  OdometryBuffer buffer_;
  std::optional<StampedPose> last_pose_;  ///< of the SLAM
};

}  // namespace datmo
