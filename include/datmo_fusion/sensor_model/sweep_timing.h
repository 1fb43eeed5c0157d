// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/sensor_model/lidar_points.h"

namespace datmo {

/// When a rotating lidar looks where: one turn, at constant speed. Bearings about the lidar in the
/// axes of base_link.
struct SweepTiming {
  double first_bearing = 0.0;  ///< rad, where the turn begins
  bool clockwise = false;      ///< seen from above
  double duration = 0.0;       ///< s, of a whole turn, more than 0
  double first_time = 0.0;     ///< s after the cloud's stamp, when the turn begins

  /// Part of the turn, 0 to 1, that is over when it looks to `bearing` (rad).
  double turned(double bearing) const;

  /// s after the cloud's stamp at which it does.
  double timeAt(double bearing) const { return first_time + duration * turned(bearing); }
};

/// The turn as the sensor's manual has it, for clouds without a time of each point.
struct SweepOptions {
  double duration = 0.0;  ///< s; 0: all points are taken as measured at the cloud's stamp
  bool clockwise = true;
  double first_bearing = 3.14159;  ///< rad
  double stamp_share = 0.0;        ///< 0 to 1, of the turn

  void visit(OptionVisitor& visitor);

  /// Nothing where the duration is 0.
  std::optional<SweepTiming> timing() const;
};

/// The turn that the times of the points (base_link, m; s after the stamp) show; `lidar`: where in
/// base_link it is. Nothing where all are measured at once, or their times do not grow with their
/// bearing as those of one turn do.
std::optional<SweepTiming> sweepOf(const LidarPoints& points, const std::vector<float>& times,
                                   const Point2& lidar);

}  // namespace datmo
