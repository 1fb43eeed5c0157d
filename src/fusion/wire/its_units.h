// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/fusion/wire/its_fields.h"

namespace datmo {

// Conversions between the units of the standard and ours.

inline constexpr double kItsDecimeter = 0.1;  ///< m
inline constexpr double kItsGeodetic = 1e-7;  ///< deg, of latitudes and longitudes
inline constexpr double kItsPercent = 0.01;   ///< 1

/// TimestampIts: milliseconds since the beginning of 2004 UTC, including the leap seconds since
/// then, which our stamps do not count.
std::int64_t toItsTime(Stamp stamp, int leap_seconds);
Stamp fromItsTime(std::int64_t milliseconds, int leap_seconds);

/// TimestampIts modulo 65.536 s, ms.
std::int64_t toGenerationTime(Stamp stamp, int leap_seconds);

/// Returns the time nearest to `now` that equals `generation_time` modulo 65.536 s.
Stamp fromGenerationTime(std::int64_t generation_time, Stamp now, int leap_seconds);

/// Returns the nearest number of units, clamped to the limits.
std::int64_t toItsUnits(double value, double unit, std::int64_t min, std::int64_t max);

/// Returns half of the 95 % interval, rounded up; values from `out_of_range` on are set to that.
std::int64_t toItsConfidence(double sigma, double unit, std::int64_t out_of_range);

/// Returns the standard deviation; none if out of range, `otherwise` if not available.
std::optional<double> fromItsConfidence(std::int64_t confidence, double unit,
                                        std::int64_t out_of_range, double otherwise);

/// Direction from east toward north, rad, and standard deviation; none if not available or out of
/// range.
struct ItsDirection {
  double angle = 0.0;
  double sigma = 0.0;
};
std::optional<ItsDirection> fromNorth(const ItsAngle& angle, double otherwise);
std::optional<ItsDirection> fromEast(const ItsAngle& angle, double otherwise);
ItsAngle toNorth(double angle, double variance);
ItsAngle toEast(double angle, double variance);

/// Returns the covariance of east and north, m^2, from the 95 % ellipse; none if out of range.
std::optional<Eigen::Matrix2d> fromEllipse(const ItsPosition& position, double otherwise);
void setEllipse(const Eigen::Matrix2d& covariance, ItsPosition& position);

}  // namespace datmo
