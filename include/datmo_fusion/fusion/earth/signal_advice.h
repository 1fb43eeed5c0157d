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
  double max_distance = 300.0;  ///< m
  double max_heading = 0.6;     ///< rad, 0.05 to 1.5: angle between the vehicle and its lane
  double lane_width = 3.5;      ///< m
  /// m, 0.1 to 50: standard deviation of the vehicle's position on the earth, above which there is
  /// no advice: a lane and a half
  double max_position_sigma = 5.0;
  double bound = 2.0;        ///< 1
  double time_margin = 0.5;  ///< s
  double stop_time = 5.0;    ///< s
  /// m/s^2, 0.5 to 10: deceleration with which the vehicle stops at yellow if it can (ITE: 3.05)
  double comfort_deceleration = 3.0;
  double reaction_time = 1.0;  ///< s, 0 to 3: time before it brakes (ITE: 1)
  double min_speed = 1.0;      ///< m/s
  double max_age = 2.0;        ///< s

  void visit(OptionVisitor& visitor);
};

/// The vehicle's front, in a local plane of east and north.
struct ApproachingHost {
  Stamp stamp;
  Point2 front = Point2::Zero();  ///< m
  double heading = 0.0;           ///< rad, counterclockwise from east
  double speed = 0.0;             ///< m/s, forward
  double speed_sigma = 0.0;       ///< m/s
  double position_sigma = 0.0;    ///< m, along the least certain axis
};

/// The signals of an intersection and the time they refer to.
struct IntersectionSignals {
  Stamp stamp;
  SpatIntersection state;
};

enum class SignalVerdict { kUnknown, kPasses, kMustBrake };

/// A lane that the vehicle may be on, and one of its signal groups.
struct MovementAdvice {
  std::int64_t lane = 0;
  std::int64_t group = 0;  ///< 0: the lane has none
  SignalState now = SignalState::kUnavailable;
  SignalState on_arrival = SignalState::kUnavailable;  ///< unavailable: unknown
  std::optional<double> min_end;     ///< s from the host's stamp, of the current state
  std::optional<double> max_end;     ///< s
  std::optional<double> likely_end;  ///< s
  SignalVerdict verdict = SignalVerdict::kUnknown;
};

struct SignalAdvice {
  SignalVerdict verdict = SignalVerdict::kUnknown;  ///< that of all movements if they agree
  std::string reason;                               ///< why it is unknown, for people
  double distance = 0.0;                            ///< m to the stop line, on the nearest lane
  double deceleration = 0.0;                        ///< m/s^2, needed to stop there
  std::optional<double> arrival;  ///< s at the current speed; none: the vehicle stands still
  std::vector<MovementAdvice> movements;
};

/// Predicts whether the vehicle can pass an intersection at its present speed: which lanes it may
/// be on, how far it is to the stop line, and what the signals show on arrival. Returns none if it
/// is on no lane that leads into the intersection.
///
/// A verdict holds for all possibilities: for the whole interval in which the signals may change,
/// for the uncertainty of the vehicle's position and speed and a time margin, for each lane that it
/// may be on, and for each of their signal groups, since the lane does not tell where the vehicle
/// wants to go. If these differ, or the arrival falls between two events, the verdict is unknown.
/// Green passes, with or without right of way; so does yellow for which the vehicle surely cannot
/// stop at `comfort_deceleration`.
std::optional<SignalAdvice> adviseSignals(const ApproachingHost& host,
                                          const std::vector<ApproachLane>& lanes,
                                          const std::optional<IntersectionSignals>& signals,
                                          const SignalAdviceOptions& options);

}  // namespace datmo
