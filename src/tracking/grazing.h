// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/tracking/beam_positions.h"
#include "datmo_fusion/tracking/motion_likelihood.h"

namespace datmo {

/// Share of what stands where a target is and seems to move so that is the end of one beam along a
/// wall, as the scanner moves past it: grazing_share where a wall may be, less where the vehicle's
/// path may lead; 0 where the target does not keep its bearing, and at rest, where no end moves.
double grazingShare(const ScanHistory& history, const BeamPositions& seen, const MovingBody& body,
                    const MotionLikelihoodOptions& options);

}  // namespace datmo
