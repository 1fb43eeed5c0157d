// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_prediction.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/tracking/kalman_filter.h"

namespace datmo {

namespace {

/// The same motion with reversed velocity.
LinearMotion timeReversed(LinearMotion motion) {
  motion.transition.middleRows<2>(2) *= -1.0;
  motion.transition.middleCols<2>(2) *= -1.0;
  motion.noise.middleRows<2>(2) *= -1.0;
  motion.noise.middleCols<2>(2) *= -1.0;
  return motion;
}

}  // namespace

void TrackPredictionOptions::visit(OptionVisitor& visitor) {
  ClassMotionOptions::visit(visitor);
  visitor.number({"heading_drift", "rad^2/s",
                  "growth of the heading's variance over the time by which a track is predicted"},
                 heading_drift, {0.0, 10.0});
}

LinearMotion motionOf(const Track& track, double seconds, const TrackPredictionOptions& options) {
  const TargetMotionOptions& motion = options.motionOf(track.objectClass());
  const double yaw_rate = track.moving ? track.yaw_rate : 0.0;
  LinearMotion result = seconds < 0.0 ? timeReversed(coordinatedTurn(-yaw_rate, motion, -seconds))
                                      : coordinatedTurn(yaw_rate, motion, seconds);
  if (!track.moving) {
    result.transition.topRightCorner<2, 4>().setZero();
  }
  return result;
}

Track predicted(Track track, double seconds, const TrackPredictionOptions& options) {
  if (seconds == 0.0) {
    return track;
  }
  const StateEstimate estimate =
      predict({track.state, track.covariance}, motionOf(track, seconds, options));
  track.state = estimate.mean;
  track.covariance = estimate.covariance;
  const double turn = track.moving ? track.yaw_rate * seconds : 0.0;
  track.box.center = Pose2(estimate.mean.head<2>(), track.box.center.heading() + turn);
  // Not more than a uniform distribution, and never less than before.
  const double drifted = track.heading_variance + options.heading_drift * std::abs(seconds);
  track.heading_variance =
      std::max(track.heading_variance, std::min(kUnknownHeadingVariance, drifted));
  track.age = std::max(0.0, track.age + seconds);
  track.since_update = std::max(0.0, track.since_update + seconds);
  return track;
}

}  // namespace datmo
