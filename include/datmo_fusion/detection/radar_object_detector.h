// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo {

/// One detection of a radar, in polar coordinates about it.
struct RadarReturn {
  double range = 0.0;       ///< m, horizontal
  double bearing = 0.0;     ///< rad, to the left of its x axis
  double range_rate = 0.0;  ///< m/s, rate of change of the range (Doppler), horizontal
};

/// The detections of a radar in one cycle.
struct RadarCycle {
  Stamp stamp;
  Pose2 radar_in_base;
  std::vector<RadarReturn> returns;
};

struct RadarObjectDetectorOptions {
  double range_sigma = 0.2;       ///< m
  double bearing_sigma = 0.01;    ///< rad
  double range_rate_sigma = 0.1;  ///< m/s
  double own_speed_sigma = 0.1;   ///< m/s
  double cluster_distance = 1.5;  ///< m
  double cluster_speed = 0.8;     ///< m/s
  int min_returns = 1;
  double reflection_sigma = 0.7;   ///< m
  double tangential_sigma = 10.0;  ///< m/s
  double min_speed = 1.0;          ///< m/s
  double wrong_velocity = 0.05;    ///< 1

  void visit(OptionVisitor& visitor);
};

/// The result for one cycle.
struct RadarObjects {
  ObjectList list;              ///< base_link at the cycle's stamp
  std::size_t standing = 0;     ///< clusters without motion along the line of sight: omitted
  std::size_t unclustered = 0;  ///< returns in no cluster: noise
};

/// Detects objects that move toward or away from a radar: clusters of returns that are close to
/// each other in position and in velocity over ground along the line of sight (DBSCAN, Ester et al.
/// 1996, by a distance that grows with the bearing's noise).
///
/// Only one component of the velocity is measured: along the line of sight, by the Doppler shift
/// minus the radar's own motion, including that from turning; across it, anything up to the speed
/// of traffic is possible. Sides are not seen: where on an object a radar reflects is random.
class RadarObjectDetector {
 public:
  /// Throws OptionError.
  explicit RadarObjectDetector(const Checked<RadarObjectDetectorOptions>& options);

  /// Detects the objects. `twist`: of the vehicle at the cycle's stamp. O(returns^2).
  RadarObjects detect(const RadarCycle& cycle, const Twist2& twist) const;

 private:
  /// A return in the vehicle's frame.
  struct Detection;

  std::vector<Detection> detectionsOf(const RadarCycle& cycle, const Twist2& twist) const;
  bool areNear(const Detection& a, const Detection& b) const;
  std::vector<std::vector<std::size_t>> clustersOf(const std::vector<Detection>& detections) const;
  Object objectOf(const std::vector<Detection>& detections, const std::vector<std::size_t>& cluster,
                  const Point2& radar) const;

  RadarObjectDetectorOptions options_;
};

}  // namespace datmo
