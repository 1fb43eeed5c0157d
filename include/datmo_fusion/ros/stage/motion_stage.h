// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/shared_options.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

struct MotionStageOptions {
  FrameOptions frames;   ///< shared by all stages
  MotionOptions motion;  ///< shared by all stages
  StreamOptions input;
};

/// It has no section of its own: `motion` is shared by all stages.
template <>
inline MotionStageOptions readStageOptions(const OptionValues& /*values*/,
                                           const SharedOptions& shared) {
  return {shared.frames, shared.motion, StreamOptions()};
}

/// Odometry for vehicles whose driver publishes none: from a sensor's twist, or from the yaw rate
/// of an IMU and the speed of a twist or of the wheels, according to MotionOptions. Used by both
/// the nodelet and the bag runner. Bad input is dropped and reported to the monitor, never thrown.
///
/// Output: nav_msgs/Odometry of the vehicle's frame at the stamp of the sensor that sets the pace
/// (the IMU, if there is one), with a pose by dead reckoning from the first one. With an IMU alone
/// the speed is unknown: 0 with a correspondingly large variance, and the pose only rotates.
///
/// Angular velocities and twists are rotated from their sensor's frame to the vehicle's by the
/// mount from tf or `mounts`; those without frame_id are assumed to be in the vehicle's frame.
class MotionStage : public Stage {
 public:
  using Options = MotionStageOptions;

  /// `transforms` and `monitor` must outlive the stage. Throws OptionError.
  MotionStage(const MotionStageOptions& options, const TransformBuffer& transforms,
              StageMonitor& monitor);

  /// Each returns the odometry that the message yields; null if it was dropped, or is only stored
  /// for use with the IMU. Not to be called for inputs that the source does not use.
  nav_msgs::OdometryPtr handleImu(const sensor_msgs::Imu& message);
  nav_msgs::OdometryPtr handleTwist(const geometry_msgs::TwistStamped& message);
  nav_msgs::OdometryPtr handleTwist(const geometry_msgs::TwistWithCovarianceStamped& message);
  /// `velocity` in rad/s of each wheel, forward positive.
  nav_msgs::OdometryPtr handleWheels(const sensor_msgs::JointState& message);

  void connect(StagePorts& ports) override;

 private:
  struct StampedSpeed {
    Stamp stamp;
    double speed = 0.0;  ///< m/s, forward
  };

  nav_msgs::OdometryPtr handleTwist(const std_msgs::Header& header,
                                    const geometry_msgs::Twist& message);
  nav_msgs::OdometryPtr keepSpeed(Stamp stamp, double speed);

  /// Speed at the stamp of an IMU; 0 without a source of speed. Throws InputError (`no_speed`).
  double speedAt(Stamp stamp) const;

  /// Rotates a vector from a sensor's frame to the vehicle's. Throws InputError.
  Eigen::Vector3d inBase(const std::string& frame, const geometry_msgs::Vector3& vector) const;

  void reset();
  nav_msgs::OdometryPtr odometryOf(const ros::Time& stamp, const Twist2& twist);

  MotionStageOptions options_;
  const TransformBuffer& transforms_;
  StageRunner runner_;
  std::optional<StampedSpeed> speed_;  ///< the newest one
  std::optional<Stamp> last_;          ///< of the last odometry
  Twist2 last_twist_;
  Pose2 base_in_odom_;
};

}  // namespace datmo
