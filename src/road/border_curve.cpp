// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/border_curve.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/cross.h"

namespace datmo {

namespace {

/// m, over which a road's heading changes little: chords of an arc of 50 m radius are too short by
/// 2e-5 of their length.
constexpr double kStep = 1.0;

/// Number of steps after which the foot of a point has converged, on curves that turn by much less
/// than a radian within its distance.
constexpr int kFootSteps = 3;

double headingChange(const BorderCurve& curve, double along) {
  return along * (curve.curvature + 0.5 * along * curve.curvature_rate);
}

/// The next pose after a short distance, along the chord.
Pose2 stepFrom(const Pose2& from, const BorderCurve& curve, double along, double step) {
  const double middle = curve.anchor.heading() + headingChange(curve, along + 0.5 * step);
  const double end = curve.anchor.heading() + headingChange(curve, along + step);
  return {from.position() + step * Point2(std::cos(middle), std::sin(middle)), end};
}

}  // namespace

BorderCurve BorderCurve::movedAlong(double distance) const {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(distance) / kStep)));
  const double step = distance / steps;
  Pose2 pose = anchor;
  for (int i = 0; i < steps; ++i) {
    pose = stepFrom(pose, *this, i * step, step);
  }
  return {pose, curvature + distance * curvature_rate, curvature_rate};
}

CurveTable::CurveTable(const BorderCurve& curve, double first, double last)
    : first_(first), anchor_(curve.anchor) {
  const auto count = static_cast<std::size_t>(std::ceil((last - first) / kStep)) + 1;
  stations_.reserve(count);
  const BorderCurve begin = curve.movedAlong(first);
  Pose2 pose = begin.anchor;
  for (std::size_t i = 0; i < count; ++i) {
    stations_.push_back({pose.position(), pose.rotate(Point2(1.0, 0.0))});
    pose = stepFrom(pose, begin, static_cast<double>(i) * kStep, kStep);
  }
}

double CurveTable::last() const {
  return first_ + static_cast<double>(stations_.size() - 1) * kStep;
}

std::size_t CurveTable::nearest(double along) const {
  const double index = std::round((along - first_) / kStep);
  const auto max = static_cast<double>(stations_.size() - 1);
  return static_cast<std::size_t>(std::min(max, std::max(0.0, index)));
}

Pose2 CurveTable::at(double along) const {
  const std::size_t index = nearest(along);
  const Station& station = stations_[index];
  const double rest = along - first_ - static_cast<double>(index) * kStep;
  return {station.position + rest * station.direction,
          std::atan2(station.direction.y(), station.direction.x())};
}

CurvePoint CurveTable::locate(const Point2& point) const {
  const Point2 ahead = anchor_.rotate(Point2(1.0, 0.0));
  CurvePoint location{ahead.dot(point - anchor_.position()), 0.0};
  for (int i = 0; i < kFootSteps; ++i) {
    const std::size_t index = nearest(location.along);
    const Station& station = stations_[index];
    const Point2 from = point - station.position;
    location.along = first_ + static_cast<double>(index) * kStep + station.direction.dot(from);
    location.aside = cross(station.direction, from);
    if (nearest(location.along) == index) {
      break;
    }
  }
  return location;
}

}  // namespace datmo
