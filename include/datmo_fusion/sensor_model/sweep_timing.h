// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/sensor_model/lidar_points.h"

namespace datmo {

/// The direction of a rotating lidar over time: one turn at constant speed. Bearings about the
/// lidar along the axes of base_link.
struct SweepTiming {
  double first_bearing = 0.0;  ///< rad, at the start of the turn
  bool clockwise = false;      ///< seen from above
  double duration = 0.0;       ///< s, of a full turn, more than 0
  double first_time = 0.0;     ///< s after the cloud's stamp, at the start of the turn

  /// Returns the fraction of the turn, 0 to 1, completed at `bearing` (rad).
  double turned(double bearing) const;

  /// Returns the corresponding time, s after the cloud's stamp.
  double timeAt(double bearing) const { return first_time + duration * turned(bearing); }
};

/// The turn according to the sensor's manual, for clouds without times of the points.
struct SweepOptions {
  double duration = 0.0;  ///< s; 0: all points are taken as simultaneous, at the cloud's stamp
  bool clockwise = true;
  double first_bearing = 3.14159;  ///< rad
  double stamp_share = 0.0;        ///< 0 to 1, of the turn

  void visit(OptionVisitor& visitor);

  /// Returns none if the duration is 0.
  std::optional<SweepTiming> timing() const;
};

/// Estimates the turn from the times of the points (base_link, m; s after the stamp); `lidar`: its
/// position in base_link. None if all are simultaneous, or their times do not grow with their
/// bearing as in one turn.
std::optional<SweepTiming> sweepOf(const LidarPoints& points, const std::vector<float>& times,
                                   const Point2& lidar);

}  // namespace datmo
