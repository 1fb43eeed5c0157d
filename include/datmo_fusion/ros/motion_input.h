#pragma once

#include <optional>
#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/ros/stamp_check.h"
#include "datmo_fusion/slam/odometry_buffer.h"

namespace datmo {

struct MotionInputOptions {
  bool odometry = true;
  bool odometry_pose = false;
  std::string odom_frame = "odom";
  double odometry_hold = 0.5;  ///< s

  void visit(OptionVisitor& visitor);
};

/// The motion of the vehicle between two stamps, as its odometry tells it; where the vehicle has
/// none, as the poses of the SLAM do.
class MotionInput {
 public:
  /// `base_frame`: of the vehicle. Throws OptionError.
  MotionInput(const MotionInputOptions& options, std::string base_frame, double restart_after);

  /// kRestart: the clock jumped back, and all that was there before is forgotten. Not read where
  /// the vehicle has no odometry. Throws InputError (`wrong_frame`, `bad_odometry`, `bad_pose`, and
  /// those of StampCheck).
  Arrival take(const nav_msgs::Odometry& message);

  /// The same for the vehicle's pose in a frame that does not move; read only where it has no
  /// odometry. Throws InputError (`bad_pose`, `pose_jump`, and those of StampCheck).
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

  MotionInputOptions options_;
  std::string base_frame_;
  double restart_after_;
  StampCheck stamps_;
  OdometryBuffer buffer_;
  std::optional<StampedPose> last_pose_;  ///< of the SLAM
};

}  // namespace datmo
