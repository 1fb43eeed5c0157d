// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Reconciles the extents of two tracks of one object at the same time, one of which may have seen
/// less of it, such as the rear of a vehicle ahead: along each axis of the more certain heading the
/// shorter box is extended to the length of the other, as far as the longer extent is certain
/// according to the variance of its center. The side that faces the sensor stays in place and the
/// center moves away from the sensor: the unseen part lies there (as in TrackedBox, within one
/// track). If the sensor is abreast, neither side faces it and the center stays.
///
/// The longer box may be too long: the variance of the center along the axis grows by that of a
/// uniform distribution between both (abreast: over the whole possible range).
///
/// @param sensor_of_a, sensor_of_b m, fixed frame: from where the tracks are seen; none: unknown,
/// and that track is not changed
void reconcileExtents(Track& a, const std::optional<Point2>& sensor_of_a, Track& b,
                      const std::optional<Point2>& sensor_of_b);

}  // namespace datmo
