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

/// How much the errors of trackers are correlated that follow one object: of each pair of tracks
/// the cross-covariance, carried on from one fusion to the next (steppedCrossCovariance). Two that
/// have just been found to be one object have shared its process noise for a while: they begin with
/// `first_correlation`.
class TrackCorrelations {
 public:
  /// A new time, `seconds` after the last one. Pairs that were not requested at the last one are
  /// forgotten.
  void step(double seconds);

  /// Of two tracks as their trackers made them, at the present: `sources` of each is itself. Each
  /// pair is requested once at each time, in either order: of b and a it is the transpose.
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
