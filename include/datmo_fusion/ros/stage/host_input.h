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

/// How the host's state is put together.
struct HostInputOptions {
  double acceleration_time = 0.5;  ///< s
  double max_age = 0.5;            ///< s

  void visit(OptionVisitor& visitor);
};

/// The host at a stamp: its pose from the labeled scans, its speed and yaw rate from the odometry,
/// or, without that, from the poses, whose jumps are none of it; its acceleration from what the
/// speed did lately.
class HostInput {
 public:
  /// `runner`: of the stage, which is to call reset() when it is reset itself; it must outlive the
  /// input.
  HostInput(const Checked<HostInputOptions>& options, const MotionOptions& motion,
            FrameOptions frames, StageRunner& runner);

  /// Throws as OdometryReader does.
  void take(const nav_msgs::Odometry& message);

  /// The pose of a scan whose stamp was checked.
  void take(const LabeledScan& scan);

  /// Throws InputError: `no_pose` if there is no scan near the stamp, `no_motion` if neither
  /// odometry nor a second pose is.
  HostState at(Stamp stamp, const HostVehicleOptions& vehicle) const;

  /// Whether the speed is the odometry's.
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
  Twists from_poses_;  ///< the same
  PoseMotion poses_;
  std::optional<StampedPose> last_pose_;
};

}  // namespace datmo
