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

/// Returns the motion of a track over `seconds`; negative: backward in time. By its most likely
/// class.
///
/// A moving object turns at its yaw rate (coordinatedTurn). A stationary one stays in place; but it
/// may start, so its uncertainty grows as if it moved. Backward in time the motion has reversed
/// velocity and yaw rate, with the process noise of the same duration.
LinearMotion motionOf(const Track& track, double seconds, const TrackPredictionOptions& options);

/// Predicts a track by `seconds`; negative: backward. State and covariance use motionOf; the box
/// moves with the state and turns at the yaw rate, and its heading variance grows. Age and the time
/// since the last object change accordingly, down to 0; all else is unchanged.
///
/// The track must be valid and `seconds` finite.
Track predicted(Track track, double seconds, const TrackPredictionOptions& options);

}  // namespace datmo
