// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>
#include <string>

#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/JointState.h>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/ros/convert/host_conversion.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

/// How the host's state is determined.
struct HostInputOptions {
  double acceleration_time = 0.5;  ///< s
  double max_age = 0.5;            ///< s
  std::string steering_joint;
  double steering_sigma = 0.01;     ///< rad
  double acceleration_sigma = 0.3;  ///< m/s^2

  void visit(OptionVisitor& visitor);
};

/// State of the host at a stamp: its pose from the labeled scans; its speed and yaw rate from
/// odometry or, without it, from the poses, excluding their jumps.
///
/// Its steering follows from the yaw rate and, if it is also measured, from both, as two
/// measurements of one angle with the noise of each (that of the poses if the yaw rate is from
/// them): the faster the host, the more the yaw rate counts. Its acceleration is the measured one,
/// otherwise that of its recent speeds, which lags behind by half of acceleration_time.
class HostInput {
 public:
  /// `runner`: of the stage, which must call reset() when it is reset itself; it must outlive the
  /// input.
  HostInput(const Checked<HostInputOptions>& options, const MotionOptions& motion,
            const FrameOptions& frames, const HostVehicleOptions& vehicle, StageRunner& runner);

  /// Throws like OdometryReader.
  void update(const nav_msgs::Odometry& message);

  /// Throw InputError like steeringFrom, accelerationFrom and StageRunner::check.
  void update(const sensor_msgs::JointState& message);
  void update(const geometry_msgs::AccelWithCovarianceStamped& message);

  /// Sets the pose of a scan whose stamp was checked.
  void update(const LabeledScan& scan);

  /// Throws InputError: `no_pose` without a scan near the stamp, `no_motion` with neither odometry
  /// nor a second pose. Warns (`old_steering`, `old_acceleration`) if steering or acceleration were
  /// measured before, but not near the stamp: then they are derived, as without these inputs.
  HostState at(Stamp stamp) const;

  /// Whether the speed is from odometry.
  bool hasOdometry(Stamp stamp) const;

  void reset();

 private:
  struct StampedTwist {
    Stamp stamp;
    Twist2 twist;
    Eigen::Matrix2d covariance;  ///< of speed (m/s) and yaw rate (rad/s)
  };
  struct StampedPose {
    Stamp stamp;
    Pose2 pose;
  };
  struct StampedEstimate {
    Stamp stamp;
    Estimate estimate;
  };
  using Twists = std::deque<StampedTwist>;

  void add(Twists& twists, const StampedTwist& twist) const;
  bool serves(const Twists& twists, Stamp stamp) const;
  /// Returns a measurement if it is near the stamp, otherwise warns. `name`: of the input.
  std::optional<Estimate> near(const std::optional<StampedEstimate>& measured, Stamp stamp,
                               const std::string& name) const;

  HostInputOptions options_;
  MotionOptions motion_;
  HostVehicleOptions vehicle_;
  SteeringFormat steering_format_;
  AccelerationFormat acceleration_format_;
  StageRunner& runner_;
  OdometryReader reader_;
  Twists odometry_;    ///< of the last acceleration_time
  Twists from_poses_;  ///< of the last acceleration_time
  PoseMotion poses_;
  std::optional<StampedPose> last_pose_;
  std::optional<StampedEstimate> steering_;      ///< rad, the newest one
  std::optional<StampedEstimate> acceleration_;  ///< m/s^2, the newest one
};

}  // namespace datmo
