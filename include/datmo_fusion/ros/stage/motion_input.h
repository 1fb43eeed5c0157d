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

/// Input check for the vehicle's odometry: its frames, rising stamps and plausible twists.
class OdometryReader {
 public:
  /// `stream`: its name at `runner`, the runner of the stage, which must call reset() when it is
  /// reset itself; the runner must outlive the reader. Throws OptionError.
  OdometryReader(const Checked<MotionOptions>& options, FrameOptions frames, std::string stream,
                 StageRunner& runner);

  /// Converts odometry according to the options: with odometry_pose also its pose, and then an
  /// implausible twist (for example the mean over a clock gap) is ignored with a warning
  /// (`bad_twist`), because the pose decides. Throws InputError (`wrong_frame`, `bad_odometry`,
  /// `bad_pose`, and those of StageRunner::check), for a measurement repeated longer than it may be
  /// held (`frozen_odometry`), and without odometry_pose for an implausible change of the twist
  /// (`impossible_twist`).
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

/// The vehicle's motion between two stamps, from odometry or, if its speed is not measured, from
/// the poses of SLAM.
class MotionInput {
 public:
  /// `runner`: of the stage, which must call reset() when it is reset itself; it must outlive the
  /// input. Throws OptionError.
  MotionInput(const Checked<MotionOptions>& options, FrameOptions frames, StageRunner& runner);

  /// Ignored if the speed is not measured. Throws like OdometryReader.
  void update(const nav_msgs::Odometry& message);

  /// The same for the vehicle's pose in a fixed frame; used only if its speed is not measured.
  /// Throws InputError (`bad_pose`, `pose_jump`, and those of StageRunner::check).
  void update(const geometry_msgs::PoseWithCovarianceStamped& message);

  /// Returns the motion from one stamp to a later one; none if unknown (OdometryBuffer::motion).
  std::optional<Pose2> between(Stamp from, Stamp to) const { return buffer_.motion(from, to); }

  /// Returns a scan as if measured at once, at its stamp (compensateMotion); unchanged if the
  /// motion is unknown.
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
