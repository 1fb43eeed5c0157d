// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/tracking/beam_positions.h"
#include "datmo_fusion/tracking/motion_likelihood.h"

namespace datmo {

/// Returns the probability that a stationary target which appears to move like this is the end of
/// one beam that slides along a wall as the scanner passes: grazing_share beside the vehicle's
/// path, less where the path may lead; 0 if the target's bearing changes, or while the scanner is
/// at rest.
double grazingShare(const ScanHistory& history, const BeamPositions& seen, const MovingBody& body,
                    const MotionLikelihoodOptions& options);

}  // namespace datmo
