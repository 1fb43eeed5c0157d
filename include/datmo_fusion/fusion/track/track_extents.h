// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Two tracks of one object at one time, one of which may have seen less of it, such as the rear of
/// a vehicle ahead: along each axis of the surer heading the shorter box is made as long as the
/// other one, as far as that one's extent is known and no guess, which the variance of its own
/// center alone allows. The side that faces its sensor stays where it is, and the center moves:
/// what a sensor has not seen lies away from it (as in TrackedBox, within one track). Where the
/// sensor is abreast, neither side faces it and the center stays.
///
/// The longer box may be too long: the variance of the center along the axis grows by that of a
/// uniform distribution between both (of all that is possible, abreast).
///
/// @param sensor_of_a, sensor_of_b m, fixed frame: from where the tracks are seen; none: not known,
/// and that track is left as it is
void reconcileExtents(Track& a, const std::optional<Point2>& sensor_of_a, Track& b,
                      const std::optional<Point2>& sensor_of_b);

}  // namespace datmo
