// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "datmo_fusion/common/pose2.h"

namespace datmo {

/// What a sensor saw at one time: a fan of beams, each of which reaches as far as the sensor saw
/// along it.
struct ViewFan {
  Pose2 sensor;                ///< in the frame of whoever holds the fan
  double first_bearing = 0.0;  ///< rad, about the sensor, of beam 0
  double beam_spacing = 0.0;   ///< rad, not 0; negative: from left to right
  double min_range = 0.0;      ///< m
  double sure_range = 0.0;     ///< m, up to here an object is seen as well as a near one
  double range = 0.0;          ///< m, from there on less and less of it, up to here
  /// A scanner, which detects what one of its beams meets; else what is not hidden is seen, by its
  /// share.
  bool by_beams = false;
  std::vector<double> reach;  ///< m, of each beam; empty: nothing is known of the view
};

/// The fan seen from the parent frame of `frame_in_parent`.
inline ViewFan transformed(const Pose2& frame_in_parent, ViewFan fan) {
  fan.sensor = frame_in_parent * fan.sensor;
  return fan;
}

}  // namespace datmo
