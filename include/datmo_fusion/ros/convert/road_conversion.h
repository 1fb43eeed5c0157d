// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "datmo_fusion/detection/border_filter.h"
#include "datmo_fusion/road/road_model.h"
#include "datmo_fusion/ros/convert/messages.h"

namespace datmo {

/// Maximum number of points of all borders of one road; no road around a vehicle needs more.
inline constexpr std::size_t kMaxBorderPoints = 10000;

/// Throws InputError: `bad_border` for a section with fewer than two points, non-finite points or
/// age, a number of standard deviations that differs from that of the points or a negative one, an
/// undefined side, or an invalid probability; `bad_road` for an invalid probability of an
/// intersection; `many_points` for more than kMaxBorderPoints.
RoadBorders toMessage(const RoadModel& road, const std::string& fixed_frame);

/// The inverse, to the message's precision (points and probabilities are single); throws the same.
/// The caller must check the frame.
RoadModel fromMessage(const RoadBorders& message);

/// Converts the objects dropped from those of a scan in `base_frame` at `stamp`.
DroppedObjects toMessage(const std::vector<DroppedObject>& dropped, Stamp stamp,
                         const std::string& base_frame);

}  // namespace datmo
