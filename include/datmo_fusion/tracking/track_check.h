// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/view_fan.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Returns whether a track can be fused: position, size and rates within the bounds of
/// physical_bounds.h, variances up to the square of kMaxCoordinate, times up to 1e9 s and the
/// heading's variance up to 1e9 rad^2, sizes, times and variances at least 0, probabilities from 0
/// to 1, those of modes and of classes summing to at most 1, and its covariance symmetric and
/// positive definite.
bool isValid(const Track& track);

/// Returns whether a fan is usable: its numbers are finite, its position and bearings are
/// within the bounds of physical_bounds.h, its spacing is not 0, every reach is from 0 to 1e9 m,
/// and there are at most kMaxBeams beams. A fan without
/// beams is valid: the view is unknown.
bool isValid(const ViewFan& fan);

}  // namespace datmo
