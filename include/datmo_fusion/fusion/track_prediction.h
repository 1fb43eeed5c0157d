#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/tracking/target_motion.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

struct TrackPredictionOptions {
  TargetMotionOptions motion;

  void visit(OptionVisitor& visitor);
};

/// The track at a time `seconds` later than its own; negative: earlier. State and covariance by
/// coordinatedTurn at its yaw rate, or standingStill where it does not move; the box turns and moves
/// with it, and its heading becomes less sure.
Track predicted(const Track& track, double seconds, const TrackPredictionOptions& options);

}  // namespace datmo
