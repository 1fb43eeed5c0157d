// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/fusion/track/cross_covariance.h"
#include "datmo_fusion/tracking/kalman_filter.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// How the states of two trackers are fused (fusedState).
enum class TrackCombinationMethod { kCovarianceIntersection, kBarShalomCampo, kInformation };

struct TrackCombinationOptions {
  TrackCombinationMethod method = TrackCombinationMethod::kCovarianceIntersection;
  double max_correlation = 0.95;  ///< 1

  void visit(OptionVisitor& visitor);
};

/// Fuses two trackers' estimates of one object at the same time.
///
/// Both share the object's process noise, so their errors are correlated (Bar-Shalom 1981).
/// covariance_intersection: consistent for any correlation (Julier & Uhlmann 1997), with the weight
/// of minimum determinant, for which position and velocity need no common unit; an estimate that is
/// better in every respect gets nearly all the weight. bar_shalom_campo: minimum variance with the
/// cross-covariance E[(a - x) (b - x)'] (Bar-Shalom & Campo 1986), limited to `max_correlation`.
/// information: assumes independence; over-confident. Only bar_shalom_campo needs `cross`.
///
/// Both covariances must be positive definite; so is the result's. Symmetric: swapping a and b and
/// transposing cross gives the same result.
StateEstimate fusedState(const StateEstimate& a, const StateEstimate& b,
                         const CrossCovariance& cross, const TrackCombinationOptions& options);

/// Returns E[(a - x) (b - x)'] of the estimates with the indices a and b.
using CrossCovarianceOf = std::function<CrossCovariance(std::size_t a, std::size_t b)>;

/// Fuses one or more estimates sequentially: each with the result of those before it, whose
/// cross-covariance with it is the mean of theirs. So with three or more the result depends on the
/// order. `cross` is called for bar_shalom_campo only.
StateEstimate fusedState(const std::vector<StateEstimate>& estimates,
                         const CrossCovarianceOf& cross, const TrackCombinationOptions& options);

/// Fuses contradictory estimates (one or more), of which it is unknown which are wrong: mean and
/// covariance of their mixture with equal weights (Bar-Shalom, Li, Kirubarajan 2001, 1.4.16; like
/// covariance union, Uhlmann 2003, it covers all). Symmetric.
StateEstimate mixtureOf(const std::vector<StateEstimate>& estimates);

/// Fuses tracks of one object at the same time (one or more).
///
/// The state is from fusedState or, if they `contradict` each other, from mixtureOf; its position
/// is the box's center. The heading is fused modulo pi by its variance, and the motion decides
/// which end is the front. A tracker infers the center from the sides that it saw and the size that
/// it assumes, so the one whose center is more certain along an axis of the box also knows the
/// box's size along it better: sizes are weighted accordingly. Height: the maximum, since a partly
/// visible object looks lower than it is. Class by Bayes with a uniform prior. Motion mode and yaw
/// rate are averaged, because all observe the same motion and are not independent evidence. The
/// result moves if any does. Hits, `sensors` and `sources` are combined, the time since the last
/// object is the minimum; `objects` is empty.
///
/// Id, existence, age and history are those of the first; apart from that, the order matters only
/// as described for fusedState. All tracks must be valid.
Track combined(const std::vector<Track>& tracks, bool contradict, const CrossCovarianceOf& cross,
               const TrackCombinationOptions& options);

}  // namespace datmo
