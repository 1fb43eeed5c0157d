// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// Returns the vehicle's motion from one stamp to a later one: its pose at `to` in its frame at
/// `from`; none if unknown (OdometryBuffer::motion).
using MotionBetween = std::function<std::optional<Pose2>(Stamp from, Stamp to)>;

/// Returns the pose of the vehicle at `stamp` in its frame at `reference`, in either time order;
/// none if the motion is unknown.
std::optional<Pose2> baseAt(Stamp stamp, Stamp reference, const MotionBetween& motion);

}  // namespace datmo
