// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/tracking/beam_positions.h"
#include "datmo_fusion/tracking/motion_likelihood.h"

namespace datmo {

/// Returns the share of standing objects at a target that seems to move like this which are ends of
/// one beam along a wall, as the scanner moves past it: grazing_share where a wall may be, less
/// where the vehicle's path may lead; 0 if the target does not keep its bearing, and at rest, when
/// no such end moves.
double grazingShare(const ScanHistory& history, const BeamPositions& seen, const MovingBody& body,
                    const MotionLikelihoodOptions& options);

}  // namespace datmo
