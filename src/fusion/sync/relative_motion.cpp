// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/sync/relative_motion.h"

namespace datmo {

std::optional<Pose2> baseAt(Stamp stamp, Stamp reference, const MotionBetween& motion) {
  if (stamp == reference) {
    return Pose2();
  }
  if (reference < stamp) {
    return motion(reference, stamp);
  }
  const std::optional<Pose2> forward = motion(stamp, reference);
  return forward ? std::make_optional(forward->inverse()) : std::nullopt;
}

}  // namespace datmo
