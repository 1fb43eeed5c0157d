// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"

namespace datmo {

/// The vehicle's motion from one stamp to a later one: its pose at `to` in its frame at `from`;
/// none if it is not known (OdometryBuffer::motion).
using MotionBetween = std::function<std::optional<Pose2>(Stamp from, Stamp to)>;

/// Pose of the vehicle at one stamp in its frame at another one, whichever is the later; none if
/// the motion is not known.
std::optional<Pose2> baseAt(Stamp stamp, Stamp reference, const MotionBetween& motion);

}  // namespace datmo
