// SPDX-License-Identifier: BSD-3-Clause
#include "its_units.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

constexpr std::int64_t kNanosecondsPerMillisecond = 1000000;
constexpr std::int64_t kMillisecondsPerSecond = 1000;
constexpr std::int64_t kEpoch = 1072915200;  // s, 2004-01-01 00:00:00 UTC, of ours
constexpr std::int64_t kGenerationPeriod = 65536;

/// Standard deviations that contain 95 % of a normal distribution; and of one in the plane.
constexpr double kSigmas = 1.96;
constexpr double kEllipseSigmas = 2.4477;

constexpr double kAngleUnit = 0.1;  // deg

std::optional<ItsDirection> direction(const ItsAngle& angle, double otherwise) {
  const std::optional<double> sigma =
      fromItsConfidence(angle.confidence, degrees(kAngleUnit), ItsAngle::kOutOfRange, otherwise);
  if (angle.value == ItsAngle::kNoValue || !sigma) {
    return std::nullopt;
  }
  return ItsDirection{degrees(kAngleUnit * static_cast<double>(angle.value)), *sigma};
}

/// `angle` in rad.
std::int64_t toItsAngle(double angle) {
  const std::int64_t value = std::llround(toDegrees(angle) / kAngleUnit) % ItsAngle::kTurn;
  return value < 0 ? value + ItsAngle::kTurn : value;
}

ItsAngle itsAngle(double angle, double variance) {
  if (variance >= kUnknownHeadingVariance) {
    return {};
  }
  return {toItsAngle(angle),
          toItsConfidence(std::sqrt(variance), degrees(kAngleUnit), ItsAngle::kOutOfRange)};
}

}  // namespace

GeodeticPosition geodeticOf(std::int64_t latitude, std::int64_t longitude) {
  return {degrees(kItsGeodetic * static_cast<double>(latitude)),
          degrees(kItsGeodetic * static_cast<double>(longitude)), 0.0};
}

std::int64_t toItsTime(Stamp stamp, int leap_seconds) {
  return stamp.nanoseconds / kNanosecondsPerMillisecond +
         kMillisecondsPerSecond * (leap_seconds - kEpoch);
}

Stamp fromItsTime(std::int64_t milliseconds, int leap_seconds) {
  return {(milliseconds + kMillisecondsPerSecond * (kEpoch - leap_seconds)) *
          kNanosecondsPerMillisecond};
}

std::int64_t toGenerationTime(Stamp stamp, int leap_seconds) {
  return toItsTime(stamp, leap_seconds) % kGenerationPeriod;
}

Stamp fromGenerationTime(std::int64_t generation_time, Stamp now, int leap_seconds) {
  const std::int64_t its_now = toItsTime(now, leap_seconds);
  const std::int64_t since =  // then, 0 to less than the period
      ((its_now - generation_time) % kGenerationPeriod + kGenerationPeriod) % kGenerationPeriod;
  const bool is_ahead = since > kGenerationPeriod / 2;
  return fromItsTime(its_now - since + (is_ahead ? kGenerationPeriod : 0), leap_seconds);
}

std::int64_t toItsUnits(double value, double unit, std::int64_t min, std::int64_t max) {
  const double units = std::round(value / unit);
  return static_cast<std::int64_t>(
      std::clamp(units, static_cast<double>(min), static_cast<double>(max)));
}

std::int64_t toItsConfidence(double sigma, double unit, std::int64_t out_of_range) {
  const double units = std::ceil(kSigmas * sigma / unit);
  return static_cast<std::int64_t>(std::clamp(units, 1.0, static_cast<double>(out_of_range)));
}

std::optional<double> fromItsConfidence(std::int64_t confidence, double unit,
                                        std::int64_t out_of_range, double otherwise) {
  if (confidence == out_of_range) {
    return std::nullopt;
  }
  return confidence > out_of_range ? otherwise : unit * static_cast<double>(confidence) / kSigmas;
}

std::optional<ItsDirection> fromNorth(const ItsAngle& angle, double otherwise) {
  std::optional<ItsDirection> found = direction(angle, otherwise);
  if (found) {
    found->angle = normalizeAngle(kQuarterTurn - found->angle);
  }
  return found;
}

std::optional<ItsDirection> fromEast(const ItsAngle& angle, double otherwise) {
  std::optional<ItsDirection> found = direction(angle, otherwise);
  if (found) {
    found->angle = normalizeAngle(found->angle);
  }
  return found;
}

ItsAngle toNorth(double angle, double variance) { return itsAngle(kQuarterTurn - angle, variance); }

ItsAngle toEast(double angle, double variance) { return itsAngle(angle, variance); }

std::optional<Eigen::Matrix2d> fromEllipse(const ItsPosition& position, double otherwise) {
  if (position.semi_major == ItsPosition::kAxisOutOfRange ||
      position.semi_minor == ItsPosition::kAxisOutOfRange) {
    return std::nullopt;
  }
  // 0 is a reserved value: treated as not available.
  const auto sigma = [&](std::int64_t axis) {
    return axis == ItsPosition::kNoAxis || axis == 0
               ? otherwise
               : kItsCentimeter * static_cast<double>(axis) / kEllipseSigmas;
  };
  const double major = sigma(position.semi_major);
  // Without direction, the larger circle covers the ellipse.
  const bool is_directed = position.major_direction != ItsAngle::kNoValue;
  const double minor = is_directed ? sigma(position.semi_minor) : major;
  const double angle = degrees(kAngleUnit * static_cast<double>(position.major_direction));
  const Eigen::Vector2d axis(std::sin(angle), std::cos(angle));
  return square(minor) * Eigen::Matrix2d::Identity() +
         (square(major) - square(minor)) * axis * axis.transpose();
}

void setEllipse(const Eigen::Matrix2d& covariance, ItsPosition& position) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance);  // by rising variance
  const auto toAxis = [](double variance) {
    const double units = std::ceil(kEllipseSigmas * std::sqrt(variance) / kItsCentimeter);
    return static_cast<std::int64_t>(
        std::clamp(units, 1.0, static_cast<double>(ItsPosition::kAxisOutOfRange)));
  };
  position.semi_minor = toAxis(std::max(0.0, axes.eigenvalues()(0)));
  position.semi_major = toAxis(std::max(0.0, axes.eigenvalues()(1)));
  const Eigen::Vector2d major = axes.eigenvectors().col(1);
  position.major_direction = toItsAngle(std::atan2(major.x(), major.y()));
}

}  // namespace datmo
