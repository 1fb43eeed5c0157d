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

/// Two trackers' estimates of one object at one time, fused.
///
/// They share the object's process noise, so that their errors are correlated (Bar-Shalom 1981).
/// covariance_intersection: consistent whatever the correlation is (Julier & Uhlmann 1997), with
/// the weight of the least determinant, in which position and velocity need no common unit; one
/// that is better in every respect has nearly all of it. bar_shalom_campo: of least variance by the
/// cross-covariance E[(a - x) (b - x)'] (Bar-Shalom & Campo 1986), no more of which is believed
/// than `max_correlation`. information: as if they were independent; over-confident. The last two
/// alone do without `cross`.
///
/// Both covariances positive definite, which the result's is too. Symmetric: a, b, cross as b, a,
/// cross'.
StateEstimate fusedState(const StateEstimate& a, const StateEstimate& b,
                         const CrossCovariance& cross, const TrackCombinationOptions& options);

/// E[(a - x) (b - x)'] of the estimates a and b of these indices.
using CrossCovarianceOf = std::function<CrossCovariance(std::size_t a, std::size_t b)>;

/// Of several (one or more), one after the other: each with what those before it are together,
/// whose cross-covariance with it is the mean of theirs. So of three or more the result depends on
/// their order. `cross` is asked by bar_shalom_campo alone.
StateEstimate fusedState(const std::vector<StateEstimate>& estimates,
                         const CrossCovarianceOf& cross, const TrackCombinationOptions& options);

/// Estimates (one or more) that contradict each other: which of them are wrong is not known. The
/// mixture of all, each as likely, by its mean and covariance (Bar-Shalom, Li, Kirubarajan 2001,
/// 1.4.16; as covariance union, Uhlmann 2003, it covers all). Symmetric.
StateEstimate mixtureOf(const std::vector<StateEstimate>& estimates);

/// Tracks at one time (one or more), taken for one object.
///
/// State by fusedState, or, if they `contradict` each other, by mixtureOf; the box's center is its
/// position. The heading is known modulo pi by its
/// variance, and by the motion where the front is. A tracker infers the center from the sides that
/// it saw and the size that it thinks of, so the one whose center is surer along an axis of the box
/// also knows better how far the box reaches along it: so are the sizes weighted. Height: the
/// greatest one, for what is seen in part looks lower than it is. Class by Bayes from even odds.
/// What all know of the motion mode and the yaw rate is the same motion seen several times, no more
/// evidence than once, so these are averaged. It moves if one says so. Hits, `sensors` and
/// `sources` are those of all, the time since the last object the shortest one; `objects` there are
/// none.
///
/// Id, existence, age and history are the first one's; of all else the order matters where
/// fusedState says so. All must be valid.
Track combined(const std::vector<Track>& tracks, bool contradict, const CrossCovarianceOf& cross,
               const TrackCombinationOptions& options);

}  // namespace datmo
