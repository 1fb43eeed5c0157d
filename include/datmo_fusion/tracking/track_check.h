// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/view_fan.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Returns whether a track can be fused: all its numbers are finite, those with a unit up to 1e9 of
/// it (variances: its square), sizes, times and the heading's variance at least 0, probabilities
/// from 0 to 1, those of modes and of classes summing to at most 1, and its covariance symmetric
/// and positive definite.
bool isValid(const Track& track);

/// Returns whether a fan is usable: its numbers are finite, its position is up to 1e9 m, its
/// spacing is not 0, no reach is negative, and there are at most kMaxBeams beams. A fan without
/// beams is valid: the view is unknown.
bool isValid(const ViewFan& fan);

}  // namespace datmo
