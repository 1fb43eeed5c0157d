// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "datmo_fusion/fusion/track/track_combination.h"
#include "datmo_fusion/fusion/track/track_prediction.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Error correlations between trackers that follow one object: for each pair of tracks the
/// cross-covariance, propagated from one fusion to the next (steppedCrossCovariance). A pair that
/// has just been associated has shared the object's process noise for a while and begins with
/// `first_correlation`.
class TrackCorrelations {
 public:
  /// Advances time by `seconds`. Pairs that were not requested in the last step are deleted.
  void step(double seconds);

  /// Returns the cross-covariance of two unfused tracks (each is its own only `sources`) at the
  /// current time. Each pair must be requested once per step, in either order: for b and a the
  /// result is transposed.
  CrossCovariance between(const Track& a, const Track& b, const TrackPredictionOptions& prediction,
                          const TrackCombinationOptions& options);

  void clear() { *this = TrackCorrelations(); }

 private:
  using Member = std::pair<std::string, std::uint32_t>;
  struct Correlation {
    CrossCovariance cross;
    CovariancePair covariances;
  };
  using Correlations = std::map<std::pair<Member, Member>, Correlation>;

  double seconds_ = 0.0;
  Correlations before_;
  Correlations present_;
};

}  // namespace datmo
