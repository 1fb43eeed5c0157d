// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// The field of view of a sensor at one time: a fan of beams, each as long as the sensor could see
/// along it.
struct ViewFan {
  Pose2 sensor;                ///< in the frame of the fan's owner
  double first_bearing = 0.0;  ///< rad, about the sensor, of beam 0
  double beam_spacing = 0.0;   ///< rad, not 0; negative: clockwise
  double min_range = 0.0;      ///< m
  double sure_range = 0.0;     ///< m, full detection probability up to here
  double range = 0.0;          ///< m, detection probability falls to 0 from sure_range to here
  /// True for a scanner, which detects what one of its beams hits; otherwise an object is detected
  /// in proportion to its share that is not hidden.
  bool by_beams = false;
  std::vector<double> reach;  ///< m, of each beam; empty: the view is unknown
};

/// Returns the fan in the parent frame of `frame_in_parent`.
inline ViewFan transformed(const Pose2& frame_in_parent, ViewFan fan) {
  fan.sensor = frame_in_parent * fan.sensor;
  return fan;
}

}  // namespace datmo
