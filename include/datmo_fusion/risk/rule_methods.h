// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/risk/risk.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Options of methods without probabilities, for comparison.
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

/// Assesses the risk with the circles of the thesis (5.3.5): host and object are circles with a
/// radius by class; an object's circle grows with the distance traveled. A vehicle keeps its speed
/// and direction, a pedestrian's circle stays in place and grows at the pedestrian's speed. The
/// first time at which they meet is the time to collision; the risk is 1 up to driver_time +
/// vehicle_time, and falls linearly to 0 at the horizon (the curve of figure 5.11 has no numbers:
/// our assumption, as are radii and growth). `host`: predicted path.
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
