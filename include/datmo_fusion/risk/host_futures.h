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
  double acceleration_spread = 0.5;  ///< m/s^2
  double acceleration_time = 2.0;    ///< s
  double lane_deviation = 0.3;       ///< m
  /// s, 0.6 to 10: time constant with which a driver returns to the lane's middle
  double lane_time = 1.2;
  double steering_spread = 0.1;  ///< m/s^2
  /// rad, 0 to 0.5: limit of steering_spread, as a steering angle: without one, a slow vehicle
  /// would turn on the spot
  double max_steering_spread = 0.02;
  double steering_time = 0.5;  ///< s
  /// s, 0.2 to 5: how far ahead a driver follows the course of the road
  double course_time = 3.0;
  double min_course_distance = 6.0;  ///< m, 1 to 50: the same at low speed
  /// 0 to 1: a less probable border of the road is not used for the course
  double border_probability = 0.7;
  /// 0 to 1: share of the time in which a driver does not follow the road, but turns off it
  double turning_share = 0.1;

  void visit(OptionVisitor& visitor);
};

/// The steering angle that follows the road.
struct CourseSteering {
  double angle = 0.0;        ///< rad
  double sigma = 0.0;        ///< rad, standard deviation of the angle
  double probability = 1.0;  ///< that the driver follows the road
};

/// Returns the steering angle that follows the course of the road: pure pursuit (Coulter 1992) of
/// the point ahead at the vehicle's present distance from each border, averaged over the borders
/// with their probability and the inverse of the variance that results from that of their points as
/// weights. A driver who follows the road is parallel to its border here, within the sway in the
/// lane; one who turns off it (`turning_share`) has any direction: by Bayes' rule, a border counts
/// the less, the more the vehicle has turned away from it. None if its standard deviation exceeds
/// `max_steering_spread`, or if no border is probable enough, does not belong to a side street, and
/// extends from beside the vehicle to that far ahead.
std::optional<CourseSteering> courseSteering(const HostState& host, const RoadModel& road,
                                             const HostVehicleOptions& vehicle,
                                             const HostFutureOptions& options);

/// Possible futures of the host: it keeps its acceleration, and its steering or, in a share of the
/// futures that is the probability of that, steers to the course of the road. Its acceleration
/// varies about the current one (first-order Gauss-Markov), and begins within the noise of that one
/// if it is measured. It sways about its course like a driver who keeps the lane: the deviation is
/// pulled back, so that it stays within a lane however far the futures reach (critically damped,
/// driven by white noise). The uncertainty of the course itself is a constant lateral acceleration,
/// which leads away from it.
class HostFutures {
 public:
  /// `course`: the intended steering; none: the current one.
  HostFutures(const HostState& host, const std::optional<CourseSteering>& course,
              const HostVehicleOptions& vehicle, const HostFutureOptions& options,
              const HorizonOptions& horizon, const RandomDraws& draws);

  const std::vector<BodyPath>& paths() const { return paths_; }
  /// The likelier path, without random deviations.
  const BodyPath& nominal() const { return nominal_; }
  /// Mean curvature of the nominal path, 1/m, positive to the left; 0 if the path is too short.
  double curvature() const { return curvature_; }

 private:
  BodyPath nominalPath(double steering) const;
  BodyPath path(double steering, std::uint32_t future, const RandomDraws& draws) const;
  void advance(BicycleState& state, double acceleration, double steering) const;

  HostState host_;
  const HostVehicleOptions& vehicle_;
  const HostFutureOptions& options_;
  const HorizonOptions& horizon_;
  BodyPath nominal_;
  double curvature_ = 0.0;  ///< 1/m
  std::vector<BodyPath> paths_;
};

}  // namespace datmo
