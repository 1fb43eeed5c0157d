// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include <nav_msgs/Odometry.h>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/common/twist2.h"
#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage_runner.h"

namespace datmo {

/// How the host's state is determined.
struct HostInputOptions {
  double acceleration_time = 0.5;  ///< s
  double max_age = 0.5;            ///< s

  void visit(OptionVisitor& visitor);
};

/// State of the host at a stamp: its pose from the labeled scans; its speed and yaw rate from
/// odometry or, without it, from the poses, excluding their jumps; its acceleration from its recent
/// speeds.
class HostInput {
 public:
  /// `runner`: of the stage, which must call reset() when it is reset itself; it must outlive the
  /// input.
  HostInput(const Checked<HostInputOptions>& options, const MotionOptions& motion,
            FrameOptions frames, StageRunner& runner);

  /// Throws like OdometryReader.
  void take(const nav_msgs::Odometry& message);

  /// Sets the pose of a scan whose stamp was checked.
  void take(const LabeledScan& scan);

  /// Throws InputError: `no_pose` without a scan near the stamp, `no_motion` with neither odometry
  /// nor a second pose.
  HostState at(Stamp stamp, const HostVehicleOptions& vehicle) const;

  /// Whether the speed is from odometry.
  bool hasOdometry(Stamp stamp) const;

  void reset();

 private:
  struct StampedTwist {
    Stamp stamp;
    Twist2 twist;
  };
  struct StampedPose {
    Stamp stamp;
    Pose2 pose;
  };
  using Twists = std::deque<StampedTwist>;

  void add(Twists& twists, const StampedTwist& twist) const;
  bool serves(const Twists& twists, Stamp stamp) const;

  HostInputOptions options_;
  MotionOptions motion_;
  OdometryReader reader_;
  Twists odometry_;    ///< of the last acceleration_time
  Twists from_poses_;  ///< of the last acceleration_time
  PoseMotion poses_;
  std::optional<StampedPose> last_pose_;
};

}  // namespace datmo
