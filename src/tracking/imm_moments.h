// SPDX-License-Identifier: BSD-3-Clause
// Mixtures of the modes of an IMM filter, as sums over arrays: trackers spend much of their time
// here.
#pragma once

#include <array>

#include "datmo_fusion/tracking/kalman_filter.h"
#include "datmo_fusion/tracking/transition_model.h"

namespace datmo {

using ModeEstimates = std::array<StateEstimate, kMotionModes>;

/// First and second moments, stacked, so that mixtures are sums: one column per mode.
inline constexpr int kMoments = kTrackState + kTrackState * kTrackState;
using ModeMoments = Eigen::Matrix<double, kMoments, kMotionModes>;

/// Moments of each mode, about an origin near all of them, so that no digits are lost. Modes of
/// probability 0 are ignored.
void momentsAbout(const TrackState& origin, const ModeEstimates& modes,
                  const ModeVector& probabilities, ModeMoments& moments);

/// `moments` times `weights`: each column of `mixed` is a mixture of all modes.
void mix(const ModeMoments& moments, const ModeMatrix& weights, ModeMoments& mixed);

/// Mean and covariance of the mode (column) that has these moments.
void estimateOf(const TrackState& origin, const ModeMoments& moments, int mode,
                StateEstimate& estimate);

/// Mean and covariance of all modes together. `result` may hold the origin.
void mixture(const TrackState& origin, const ModeEstimates& modes, const ModeVector& probabilities,
             StateEstimate& result);

}  // namespace datmo
