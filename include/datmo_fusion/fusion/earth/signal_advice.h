// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/fusion/earth/intersection_lanes.h"
#include "datmo_fusion/fusion/wire/spatem.h"

namespace datmo {

struct SignalAdviceOptions {
  double max_distance = 300.0;        ///< m
  double max_heading = 0.6;           ///< rad
  double lane_width = 3.5;            ///< m
  double max_position_sigma = 5.0;    ///< m
  double bound = 2.0;                 ///< 1
  double time_margin = 0.5;           ///< s
  double stop_time = 5.0;             ///< s
  double comfort_deceleration = 3.0;  ///< m/s^2
  double reaction_time = 1.0;         ///< s
  double min_speed = 1.0;             ///< m/s
  double max_age = 2.0;               ///< s

  void visit(OptionVisitor& visitor);
};

/// The vehicle's front, in a local plane of east and north.
struct ApproachingHost {
  Stamp stamp;
  Point2 front = Point2::Zero();  ///< m
  double heading = 0.0;           ///< rad, from east to the left
  double speed = 0.0;             ///< m/s, ahead
  double speed_sigma = 0.0;       ///< m/s
  double position_sigma = 0.0;    ///< m, along the worst axis
};

/// The lights of an intersection, and when they were so.
struct IntersectionSignals {
  Stamp stamp;
  SpatIntersection state;
};

enum class SignalVerdict { kUnknown, kPasses, kMustBrake };

/// A lane that the vehicle may be on, and one group of lights of it.
struct MovementAdvice {
  std::int64_t lane = 0;
  std::int64_t group = 0;  ///< 0: the lane has none
  SignalState now = SignalState::kUnavailable;
  SignalState on_arrival = SignalState::kUnavailable;  ///< unavailable: not known
  std::optional<double> min_end;                       ///< s from the host's stamp, of what is now
  std::optional<double> max_end;                       ///< s
  std::optional<double> likely_end;                    ///< s
  SignalVerdict verdict = SignalVerdict::kUnknown;
};

struct SignalAdvice {
  SignalVerdict verdict = SignalVerdict::kUnknown;  ///< that of all movements if they agree
  std::string reason;                               ///< of one that is not known, for people
  double distance = 0.0;          ///< m to the stop line, of the lane that is nearest
  double deceleration = 0.0;      ///< m/s^2, with which it stops there
  std::optional<double> arrival;  ///< s at this speed; none: it stands
  std::vector<MovementAdvice> movements;
};

/// Whether the vehicle passes an intersection at its speed: which lanes it may be on, how far it is
/// to the stop line, and what the lights show when it gets there. None if it is on no lane that
/// leads into the intersection.
///
/// A verdict holds for all that may be: for the whole time from the first to the last end that the
/// lights may have, for the vehicle's position and speed and a margin of time, for each lane that
/// it may be on, and for each of their groups, since the lane does not say where it wants to go.
/// What differs among these is not known, nor what lies between two events. Green with right of way
/// or not passes; yellow that it surely cannot stop for at `comfort_deceleration` passes, too.
std::optional<SignalAdvice> adviseSignals(const ApproachingHost& host,
                                          const std::vector<ApproachLane>& lanes,
                                          const std::optional<IntersectionSignals>& signals,
                                          const SignalAdviceOptions& options);

}  // namespace datmo
