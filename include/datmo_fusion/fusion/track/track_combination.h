// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

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

/// Two estimates that contradict each other: one of them is wrong, and which one is not known. The
/// mixture of both, each as likely, by its mean and covariance (Bar-Shalom, Li, Kirubarajan 2001,
/// 1.4.16; as covariance union, Uhlmann 2003, it covers both).
StateEstimate mixtureOf(const StateEstimate& a, const StateEstimate& b);

/// Two tracks at one time, taken for one object.
///
/// State by fusedState, or, if they `contradict` each other, by mixtureOf; the box's center is its
/// position. The heading is known modulo pi by its
/// variance, and by the motion where the front is. A tracker infers the center from the sides that
/// it saw and the size that it thinks of, so the one whose center is surer along an axis of the box
/// also knows better how far the box reaches along it: so are the sizes weighted. Height: the
/// greater one, for what is seen in part looks lower than it is. Class by Bayes from even odds.
/// What both know of the motion mode and the yaw rate is the same motion seen twice, no more
/// evidence than one, so these are averaged. It moves if one says so. Hits, `sensors` and `sources`
/// are those of both, the time since the last object the shorter one; `objects` there are none.
///
/// Id, existence, age and history are a's; all else is symmetric. Both must be valid.
Track combined(Track a, const Track& b, bool contradict, const CrossCovariance& cross,
               const TrackCombinationOptions& options);

}  // namespace datmo
