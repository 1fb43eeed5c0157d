// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/fusion/wire/spatem.h"

namespace datmo {

constexpr double kEver = std::numeric_limits<double>::infinity();

/// s; how far a mark may lie in the past if the later of its possible times is meant (message
/// latency).
constexpr double kLatePast = 2.0;
/// s; the same if the earlier time is meant: of its possible times the mark then has the nearest.
constexpr double kLongPast = 1800.0;

/// The first and the last possible time, s after the host's stamp.
struct TimeSpan {
  double first = 0.0;
  double last = 0.0;
};

/// Returns the time that the message gives for an intersection's signals; none if it gives none.
/// The year is chosen so that the time is nearest to `now`. Times are UTC, as ROS time is.
std::optional<Stamp> stampOf(const Spatem& message, const SpatIntersection& intersection,
                             Stamp now);

/// Converts a mark within the hour (SpatTiming) to the first such time that is not before `now` -
/// `max_past` (s, 0 to 3600), since a mark may be up to an hour ahead. None if the mark is unknown
/// or more than an hour ahead.
std::optional<Stamp> stampOfMark(const std::optional<std::int64_t>& mark, Stamp now,
                                 double max_past);

/// Returns the seconds from `from` to a mark in a message with stamp `reference`.
std::optional<double> secondsTo(const std::optional<std::int64_t>& mark, Stamp reference,
                                Stamp from, double max_past = kLatePast);

/// Returns when an event ends; a missing bound is infinite. A mark does not tell its hour: the
/// first end takes the earlier possible time, the last end the later one. If they are in the wrong
/// order, the earlier of both is the first end and there is no last one.
TimeSpan endOf(const SpatEvent& event, Stamp reference, Stamp from);

/// When an event begins, given that the event before it ends within `before`, and until when before
/// that the state is not given.
struct EventStart {
  TimeSpan span;
  double gap_end = -kEver;  ///< s after the host's stamp; the gap begins at the start of `before`
};

EventStart startOf(const SpatEvent& event, const TimeSpan& before, bool is_first, Stamp reference,
                   Stamp from);

}  // namespace datmo
