// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/class_motion.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

struct TrackPredictionOptions : ClassMotionOptions {
  double heading_drift = 0.05;  ///< rad^2/s

  void visit(OptionVisitor& visitor);
};

/// How the state of a track changes over `seconds`, or, less than 0, how it was before: by its most
/// likely class.
///
/// What moves turns at its yaw rate (coordinatedTurn). What stands stays where it is; but it may
/// start, so it becomes less sure as if it moved. Time that runs backward is the same motion with
/// velocity and yaw rate reversed: the process noise is that of the time between, to either side.
LinearMotion motionOf(const Track& track, double seconds, const TrackPredictionOptions& options);

/// The track at a time `seconds` later than its own; less than 0: earlier. State and covariance by
/// motionOf; the box moves with the state and turns at the yaw rate, and its heading becomes less
/// sure. Age and the time since the last object change with the time, down to 0; all else stays.
///
/// The track must be valid, and `seconds` finite.
Track predicted(Track track, double seconds, const TrackPredictionOptions& options);

}  // namespace datmo
