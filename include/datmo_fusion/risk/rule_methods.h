// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/risk/risk.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Options of methods without probabilities, for comparison.
struct RuleOptions {
  /// s, 0 to 5: reaction time of a driver (thesis 5.3.5: Zhang et al. 2006)
  double driver_time = 1.0;
  double vehicle_time = 1.0;  ///< s, 0 to 5: reaction time of the vehicle (thesis 5.3.5)
  double host_radius = 1.5;   ///< m
  /// m, 0.1 to 10: radius of the circle of a vehicle or anything else but a pedestrian (thesis
  /// 5.3.5; our assumption)
  double vehicle_radius = 1.5;
  /// m, 0.1 to 10: radius of a pedestrian's circle (thesis 5.3.5: predefined; our assumption)
  double pedestrian_radius = 0.5;
  double growth = 0.1;  ///< 1
  /// 0.1 to 10: exponent by which the risk falls between reaction time and horizon; 1: a straight
  /// line (thesis 5.3.5; our assumption)
  double curve = 1.0;
  /// s, 0 to 5: rss: response time (Shalev-Shwartz et al. 2017), a usual value
  double response_time = 0.75;
  /// m/s^2, 0 to 10: rss: acceleration of all road users within the response time
  double response_acceleration = 2.0;
  double host_braking = 4.0;  ///< m/s^2
  /// m/s^2, 0.1 to 15: rss: largest deceleration of a vehicle ahead
  double vehicle_braking = 8.0;
  double cyclist_braking = 6.0;  ///< m/s^2, 0.1 to 15: rss: the same for a cyclist
  /// m/s^2, 0.1 to 15: rss: the same for a pedestrian, who stops at once
  double pedestrian_braking = 10.0;
  double lateral_braking = 0.8;  ///< m/s^2, 0.1 to 15: rss: lateral deceleration
  /// m/s^2, 0 to 10: rss: lateral acceleration within the response time
  double lateral_acceleration = 0.2;
  /// m, 0 to 5: rss: lateral distance by which all road users sway in their lane
  double lateral_margin = 0.2;

  void visit(OptionVisitor& visitor);
};

/// Assesses the risk with the circles of the thesis (5.3.5): host and object are circles with a
/// radius by class; an object's circle grows with the distance traveled. A vehicle keeps its speed
/// and direction, a pedestrian's circle stays in place and grows at the pedestrian's speed. The
/// first time at which they meet is the time to collision; the risk is 1 up to driver_time +
/// vehicle_time, and falls to 0 at the horizon by the exponent `curve` (figure 5.11 has no numbers:
/// a straight line is our assumption, as are radii and growth). `host`: predicted path.
ObjectRisk thesisRisk(const Track& track, const BodyPath& host, const RuleOptions& options);

/// Assesses the risk of boxes at constant velocity: contact is certain from the first time at which
/// they meet.
ObjectRisk boxRisk(const Track& track, const BodyPath& host, const BodySize& host_size,
                   const RuleOptions& options);

/// Assesses the risk by responsibility-sensitive safety: certain if both the longitudinal and the
/// lateral distance are below those that the braking distances of both require, by class
/// (Shalev-Shwartz, Shammah, Shashua, On a Formal Model of Safe and Scalable Self-driving Cars,
/// 2017, lemmas 2 and 4). `host`: predicted path, from its current pose.
ObjectRisk rssRisk(const Track& track, const BodyPath& host, const BodySize& host_size,
                   const RuleOptions& options);

}  // namespace datmo
