// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/risk/risk.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Methods without probabilities, to compare with.
struct RuleOptions {
  double driver_time = 1.0;            ///< s
  double vehicle_time = 1.0;           ///< s
  double host_radius = 1.5;            ///< m
  double vehicle_radius = 1.5;         ///< m
  double pedestrian_radius = 0.5;      ///< m
  double growth = 0.1;                 ///< 1
  double response_time = 0.75;         ///< s
  double response_acceleration = 2.0;  ///< m/s^2
  double host_braking = 4.0;           ///< m/s^2
  double vehicle_braking = 8.0;        ///< m/s^2
  double cyclist_braking = 6.0;        ///< m/s^2
  double pedestrian_braking = 10.0;    ///< m/s^2
  double lateral_braking = 0.8;        ///< m/s^2
  double lateral_acceleration = 0.2;   ///< m/s^2
  double lateral_margin = 0.2;         ///< m

  void visit(OptionVisitor& visitor);
};

/// The thesis's circles (5.3.5): host and object are circles by class, an object's grows with the
/// distance that it has gone; a vehicle keeps its speed and direction, of a pedestrian the circle
/// stays and grows at his speed. The first time at which they meet is the time to collision; the
/// risk is 1 up to driver_time + vehicle_time, and falls evenly to 0 at the horizon (the curve of
/// figure 5.11 has no numbers: our assumption, as are radii and growth). `host`: as it would go.
ObjectRisk thesisRisk(const Track& track, const BodyPath& host, const RuleOptions& options);

/// Boxes that keep their velocity: contact is certain from the first time on at which they meet.
ObjectRisk boxRisk(const Track& track, const BodyPath& host, const BodySize& host_size,
                   const RuleOptions& options);

/// Responsibility-sensitive safety: certain where both the longitudinal and the lateral distance
/// are below those that the braking distances of both ask for, by class (Shalev-Shwartz, Shammah,
/// Shashua, On a Formal Model of Safe and Scalable Self-driving Cars, 2017, lemmas 2 and 4).
/// `host`: as it would go; its first pose is where it is.
ObjectRisk rssRisk(const Track& track, const BodyPath& host, const BodySize& host_size,
                   const RuleOptions& options);

}  // namespace datmo
