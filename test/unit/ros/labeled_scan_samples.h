// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "message_samples.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::samples {

/// 81 beams, from 80 degrees to the right to 80 degrees to the left.
inline ScanField wideField() {
  ScanField field;
  field.beams = 81;
  field.beam_spacing = kPi / 90.0;
  field.first_bearing = -40.0 * field.beam_spacing;
  field.free_range = 40.0;
  field.range = 50.0;
  return field;
}

/// A scan with a moving point, some time (s) after kStart (m, base frame = map).
inline LabeledScan scanWithMover(const Point2& position, double seconds) {
  LabeledScan scan;
  scan.stamp = Stamp::fromSeconds(kStart + seconds);
  scan.field = wideField();
  const double bearing = std::atan2(position.y(), position.x());
  const double beam = (bearing - scan.field.first_bearing) / scan.field.beam_spacing;
  scan.points = {{position, position.norm(), bearing, static_cast<std::uint32_t>(std::lround(beam)),
                  PointState::kMoving}};
  return scan;
}

inline constexpr double kWallBeside = 5.0;  // m, from the vehicle's path to each wall

/// A scan between two walls along x, from a vehicle that has driven between them at 5 m/s since
/// kStart.
inline LabeledScan scanBetweenWalls(double seconds) {
  constexpr double kSpeed = 5.0;  // m/s
  LabeledScan scan;
  scan.stamp = Stamp::fromSeconds(kStart + seconds);
  scan.base_in_map.pose = Pose2(kSpeed * seconds, 0.0, 0.0);
  scan.field = wideField();
  for (std::uint32_t beam = 0; beam < scan.field.beams; ++beam) {
    const double bearing = scan.field.first_bearing + beam * scan.field.beam_spacing;
    const Point2 along(std::cos(bearing), std::sin(bearing));
    const double range = kWallBeside / std::max(std::abs(along.y()), 1e-3);
    if (range < scan.field.free_range) {
      scan.points.push_back({range * along, range, bearing, beam, PointState::kStatic});
    }
  }
  return scan;
}

}  // namespace datmo::samples
