// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/fusion/wire/spatem.h"

namespace datmo {

/// When an intersection's lights were as the message says; none where it does not say so. The year
/// is the one in which that is nearest to `now`. Times are UTC, as ROS time is.
std::optional<Stamp> stampOf(const Spatem& message, const SpatIntersection& intersection,
                             Stamp now);

/// A mark of the hour (SpatTiming), in the hour in which it is nearest to `now`; none for one that
/// says nothing, or is more than an hour ahead.
std::optional<Stamp> stampOfMark(const std::optional<std::int64_t>& mark, Stamp now);

}  // namespace datmo
