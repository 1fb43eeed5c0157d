// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/fusion/wire/spatem.h"

namespace datmo {

constexpr double kEver = std::numeric_limits<double>::infinity();

/// s, by which a mark may be past where the later of its times is meant: the message was on its
/// way.
constexpr double kLatePast = 2.0;
/// s, the same where the earlier one is meant: that is nearest.
constexpr double kLongPast = 1800.0;

/// From the first to the last time that is possible, s after the host's stamp.
struct TimeSpan {
  double first = 0.0;
  double last = 0.0;
};

/// When an intersection's lights were as the message says; none where it does not say so. The year
/// is the one in which that is nearest to `now`. Times are UTC, as ROS time is.
std::optional<Stamp> stampOf(const Spatem& message, const SpatIntersection& intersection,
                             Stamp now);

/// A mark of the hour (SpatTiming): the first time of that mark that is not before `now` -
/// `max_past` (s, 0 to 3600), since a mark may be up to an hour ahead. None for one that says
/// nothing, or is more than an hour ahead.
std::optional<Stamp> stampOfMark(const std::optional<std::int64_t>& mark, Stamp now,
                                 double max_past);

/// s after `from` of a mark that a message of `reference` has.
std::optional<double> secondsTo(const std::optional<std::int64_t>& mark, Stamp reference,
                                Stamp from, double max_past = kLatePast);

/// When an event ends: what is not given may be any time. A mark does not say its hour: the first
/// end is the earlier one that it may mean, the last one the later. Ends in the wrong order bound
/// nothing after the first.
TimeSpan endOf(const SpatEvent& event, Stamp reference, Stamp from);

/// When an event begins, after the one before it, which ends within `before`; and until when before
/// that nothing is given.
struct EventStart {
  TimeSpan span;
  double gap_end = -kEver;  ///< s after the host's stamp; the gap begins at `before`'s first
};

EventStart startOf(const SpatEvent& event, const TimeSpan& before, bool is_first, Stamp reference,
                   Stamp from);

}  // namespace datmo
