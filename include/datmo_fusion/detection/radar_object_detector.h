// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo {

/// One detection of a radar, relative to it.
struct RadarReturn {
  double range = 0.0;       ///< m, seen from above
  double bearing = 0.0;     ///< rad, to the left of its x axis
  double range_rate = 0.0;  ///< m/s, by which the range changes (Doppler), from above
};

/// What a radar has detected in one cycle.
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

/// What was found in one cycle.
struct RadarObjects {
  ObjectList list;              ///< base_link at the cycle's stamp
  std::size_t standing = 0;     ///< clusters without motion along the line of sight: left out
  std::size_t unclustered = 0;  ///< returns in no cluster: noise
};

/// Objects that move toward or away from a radar: clusters of returns that are near to each other,
/// in position and in velocity over the ground along the line of sight (DBSCAN, Ester et al. 1996,
/// by a distance that grows with the bearing's noise).
///
/// The velocity has two axes of which one was measured: along the line of sight by the Doppler
/// shift, less what the vehicle itself moves the radar, its turning included; across it anything up
/// to the speed of what drives. Sides are not seen: where on an object a radar reflects is chance.
class RadarObjectDetector {
 public:
  /// Throws OptionError.
  explicit RadarObjectDetector(const Checked<RadarObjectDetectorOptions>& options);

  /// `twist`: of the vehicle at the cycle's stamp. Takes time with the square of the returns.
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
