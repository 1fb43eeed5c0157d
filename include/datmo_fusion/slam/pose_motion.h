// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/slam/twist_gate.h"

namespace datmo {

/// The motion since the previous pose.
struct PoseStep {
  Twist2 twist;  ///< its speed is that of the position, including sideways
  /// Standard deviations of speed (m/s) and yaw rate (rad/s), from those of the poses.
  Eigen::Vector2d sigma = Eigen::Vector2d::Zero();
  bool jumped = false;  ///< implausible for a vehicle: the pose was corrected
  Pose2 traveled;       ///< motion since the first pose, without jumps
};

/// Derives a vehicle's motion from its poses in a map, if nothing else measures it. A pose that is
/// recovered after a gap, or corrected, jumps; a vehicle does not: a change that its last motion
/// and its limits (TwistGate) do not explain is not treated as motion.
class PoseMotion {
 public:
  /// Throws OptionError.
  PoseMotion(const TwistGateOptions& change, const OdometryNoiseOptions& noise);

  /// Adds a pose, in ascending stamp order; returns none for the first one.
  std::optional<PoseStep> add(Stamp stamp, const PoseWithCovariance& pose);

  void reset();

 private:
  struct Last {
    Stamp stamp;
    PoseWithCovariance pose;
  };

  TwistGate gate_;
  std::optional<Last> last_;
  Twist2 twist_;    ///< the last plausible one
  Pose2 traveled_;  ///< since the first pose
};

}  // namespace datmo
