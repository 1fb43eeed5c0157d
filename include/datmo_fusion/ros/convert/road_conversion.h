// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "datmo_fusion/road/border_filter.h"
#include "datmo_fusion/road/road_model.h"
#include "datmo_fusion/ros/convert/messages.h"

namespace datmo {

/// The borders of one road have at most as many points in all: no road about a vehicle needs more.
inline constexpr std::size_t kMaxBorderPoints = 10000;

/// Throws InputError: `bad_border` for a stretch of fewer than two points, points or an age that
/// are not finite, another number of standard deviations than of points or one below zero, a side
/// without a name, a probability that is none; `bad_road` for the probability of an intersection;
/// `many_points` for more than kMaxBorderPoints.
RoadBorders toMessage(const RoadModel& road, const std::string& fixed_frame);

/// The inverse, to the message's precision (points and probabilities are single); throws the same.
/// The frame is the caller's to check.
RoadModel fromMessage(const RoadBorders& message);

/// What was left out of the objects of a scan in `base_frame` at `stamp`.
DroppedObjects toMessage(const std::vector<DroppedObject>& dropped, Stamp stamp,
                         const std::string& base_frame);

}  // namespace datmo
