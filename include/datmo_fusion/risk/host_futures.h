// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/risk/host_motion.h"
#include "datmo_fusion/risk/object_futures.h"
#include "datmo_fusion/risk/random_draws.h"
#include "datmo_fusion/road/road_model.h"

namespace datmo {

struct HostFutureOptions {
  double acceleration_spread = 0.5;   ///< m/s^2
  double steering_spread = 0.3;       ///< m/s^2
  double max_steering_spread = 0.02;  ///< rad
  double steering_time = 0.5;         ///< s
  double course_time = 1.5;           ///< s
  double min_course_distance = 6.0;   ///< m
  double border_probability = 0.7;

  void visit(OptionVisitor& visitor);
};

/// The steering (rad) that follows the course of the road: pure pursuit (Coulter 1992) of the point
/// ahead that lies beside each border as the vehicle does now; the mean over the borders, weighted
/// by their probability. None without borders that are likely enough, are not of a side street, and
/// reach from beside the vehicle to that far ahead.
std::optional<double> courseSteering(const HostState& host, const RoadModel& road,
                                     const HostVehicleOptions& vehicle,
                                     const HostFutureOptions& options);

/// Possible futures of the host: it keeps its acceleration and its steering, or turns to the course
/// of the road, each with a spread that the driver's next seconds need.
class HostFutures {
 public:
  /// `course`: the steering to come to, rad; none: the present one.
  HostFutures(const HostState& host, const std::optional<double>& course,
              const HostVehicleOptions& vehicle, const HostFutureOptions& options,
              const HorizonOptions& horizon, const RandomDraws& draws);

  const std::vector<BodyPath>& paths() const { return paths_; }
  /// Without spread.
  const BodyPath& nominal() const { return nominal_; }

 private:
  BodyPath path(double acceleration, double steering) const;

  HostState host_;
  const HostVehicleOptions& vehicle_;
  const HostFutureOptions& options_;
  const HorizonOptions& horizon_;
  BodyPath nominal_;
  std::vector<BodyPath> paths_;
};

}  // namespace datmo
