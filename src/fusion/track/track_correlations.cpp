// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_correlations.h"

namespace datmo {

namespace {

/// Error correlation of two trackers when they are found to follow one object, which they have done
/// for a while (Chen, Kirubarajan and Bar-Shalom 2003: about 0.4).
constexpr double kFirstCorrelation = 0.4;

/// It is unknown which of the two has the better motion estimate.
LinearMotion meanMotion(const LinearMotion& a, const LinearMotion& b) {
  return {0.5 * (a.transition + b.transition), 0.5 * (a.noise + b.noise)};
}

}  // namespace

void TrackCorrelations::step(double seconds) {
  seconds_ = seconds;
  before_ = std::move(present_);
  present_.clear();
}

CrossCovariance TrackCorrelations::between(const Track& a, const Track& b,
                                           const TrackPredictionOptions& prediction,
                                           const TrackCombinationOptions& options) {
  const auto member = [](const Track& track) {
    return Member(track.sources.front().source, track.sources.front().id);
  };
  if (member(b) < member(a)) {
    return between(b, a, prediction, options).transpose();
  }
  const auto key = std::make_pair(member(a), member(b));
  const CovariancePair now{a.covariance, b.covariance};
  const auto known = before_.find(key);
  CrossCovariance cross =
      known == before_.end()
          ? evenCrossCovariance(now, kFirstCorrelation)
          : steppedCrossCovariance(
                known->second.cross, known->second.covariances, now,
                meanMotion(motionOf(a, seconds_, prediction), motionOf(b, seconds_, prediction)),
                options.max_correlation);
  present_[key] = {cross, now};
  return cross;
}

}  // namespace datmo
