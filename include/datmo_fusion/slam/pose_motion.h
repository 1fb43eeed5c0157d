// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/slam/twist_gate.h"

namespace datmo {

/// What one pose says of the motion since the last one.
struct PoseStep {
  Twist2 twist;         ///< its speed is that of the position, sideways too
  bool jumped = false;  ///< no vehicle moves like that: the pose was corrected
  Pose2 traveled;       ///< motion since the first pose, without the jumps
};

/// The motion of a vehicle from its poses in a map, where nothing else measures it. A pose that is
/// found again after a gap, or corrected, jumps; a vehicle does not: what its last motion and what
/// it can do to it (TwistGate) do not explain is no motion.
class PoseMotion {
 public:
  /// Throws OptionError.
  PoseMotion(const TwistGateOptions& change, const OdometryNoiseOptions& noise);

  /// By rising stamp; none for the first pose.
  std::optional<PoseStep> add(Stamp stamp, const PoseWithCovariance& pose);

  void reset();

 private:
  struct Last {
    Stamp stamp;
    PoseWithCovariance pose;
  };

  TwistGate gate_;
  std::optional<Last> last_;
  Twist2 twist_;    ///< the last one that a vehicle can have
  Pose2 traveled_;  ///< since the first pose
};

}  // namespace datmo
