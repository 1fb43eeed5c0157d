// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "simulator/laser_scanner.h"
#include "simulator/world.h"

namespace datmo::simulator {

/// An ego vehicle that starts at the origin and drives along x at a constant speed (m/s).
inline Mover egoAlongX(double speed) {
  return {objectKind("car"), Path({{0.0, 0.0}, {1000.0, 0.0}}, 0.0), SpeedProfile({{0.0, speed}}),
          0.0};
}

/// No road, nothing on it, and the ego vehicle at rest at the origin.
inline World emptyWorld() { return {RoadNetwork(), egoAlongX(0.0)}; }

/// A wall across x, wide enough for all beams ahead.
inline Solid wallAt(double x, double height = 3.0) {
  return {Segment{{x, -100.0}, {x, 100.0}}, height, Surface::kBody, kNoObject};
}

/// A scanner without faults at the origin.
inline LaserScannerOptions idealScanner() {
  LaserScannerOptions options;
  options.mount_x = 0.0;
  options.horizontal_opening = 0.0;
  options.sub_rays = 1;
  options.range_noise = 0.0;
  options.azimuth_noise = 0.0;
  options.azimuth_shake = 0.0;
  options.pitch_shake = 0.0;
  options.full_detection_share = 0.01;
  options.curb_hit_probability = 0.0;
  options.paint_hit_probability = 0.0;
  return options;
}

/// The beam straight ahead.
inline const std::vector<Echo>& middleBeam(const EchoScan& scan) {
  return scan.beams[scan.beams.size() / 2];
}

}  // namespace datmo::simulator
