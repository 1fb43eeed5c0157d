// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/stage/frozen_odometry.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/slam/odometry_buffer.h"
#include "datmo_fusion/slam/pose_motion.h"
#include "datmo_fusion/slam/twist_gate.h"

namespace datmo {

/// Input check of a stage for odometry: of the vehicle, in its frames, with stamps that rise and
/// twists that a vehicle can have.
class OdometryReader {
 public:
  /// `stream`: its name at the runner, of the stage, which is to call reset() when it is reset
  /// itself; the runner must outlive the reader. Throws OptionError.
  OdometryReader(const Checked<MotionOptions>& options, FrameOptions frames, std::string stream,
                 StageRunner& runner);

  /// What the options take of odometry: with odometry_pose its pose, too, and then a twist that no
  /// vehicle has (the mean over a gap of clocks, say) is left out and warned of (`bad_twist`): the
  /// pose is what counts. Throws InputError (`wrong_frame`, `bad_odometry`, `bad_pose`, and those
  /// of StageRunner::check), for a measurement that is repeated for longer than it serves
  /// (`frozen_odometry`), and without odometry_pose for a change of the twist that no vehicle
  /// can make (`impossible_twist`).
  OdometrySample read(const nav_msgs::Odometry& message);

  void reset() {
    frozen_.reset();
    gate_.reset();
  }

 private:
  OdometrySample sampleOf(const nav_msgs::Odometry& message) const;

  MotionOptions options_;
  FrameOptions frames_;
  std::string stream_;
  StageRunner& runner_;
  FrozenOdometry frozen_;
  TwistGate gate_;
};

/// The motion of the vehicle between two stamps, as its odometry measures it; where its speed is
/// not measured, as the poses of the SLAM do.
class MotionInput {
 public:
  /// `runner`: of the stage, which is to call reset() when it is reset itself; it must outlive the
  /// input. Throws OptionError.
  MotionInput(const Checked<MotionOptions>& options, FrameOptions frames, StageRunner& runner);

  /// Not read where the speed is not measured. Throws as OdometryReader does.
  void take(const nav_msgs::Odometry& message);

  /// The same for the vehicle's pose in a frame that does not move; read only where its speed
  /// is not measured. Throws InputError (`bad_pose`, `pose_jump`, and those of StageRunner::check).
  void take(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// From one stamp to a later one; none if it is not known (OdometryBuffer::motion).
  std::optional<Pose2> between(Stamp from, Stamp to) const { return buffer_.motion(from, to); }

  /// A scan as measured at once, at its stamp (compensateMotion); as it is where the motion is not
  /// known.
  Scan compensated(const Scan& scan) const;

  /// Forgets everything.
  void reset();

 private:
  MotionOptions options_;
  StageRunner& runner_;
  OdometryReader odometry_;
  OdometryBuffer buffer_;
  PoseMotion poses_;  ///< of the SLAM
};

}  // namespace datmo
