// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/view_fan.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Whether a track can be fused: all its numbers are finite, those that have a unit to 1e9 of it
/// (variances: its square), sizes, times and the heading's variance at least 0, probabilities from
/// 0 to 1, those of modes and of classes not more than 1 together, its covariance symmetric and
/// positive definite.
bool isValid(const Track& track);

/// Whether a fan can be looked up: its numbers are finite, its position up to 1e9 m, its
/// spacing is not 0, no beam reaches less than 0, and there are kMaxBeams of them at most. One
/// without beams is valid: nothing is known of the view.
bool isValid(const ViewFan& fan);

}  // namespace datmo
