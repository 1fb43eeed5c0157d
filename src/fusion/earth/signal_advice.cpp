// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/signal_advice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/fusion/earth/signal_times.h"

namespace datmo {

namespace {

constexpr std::int64_t kNoGroup = 0;  ///< DE SignalGroupID: not known

struct Candidate {
  const ApproachLane* lane = nullptr;
  LanePosition position;
};

bool isGreen(SignalState state) {
  return state == SignalState::kPermissive || state == SignalState::kProtected;
}

bool isYellow(SignalState state) {
  return state == SignalState::kPermissiveClearance || state == SignalState::kProtectedClearance;
}

bool isRed(SignalState state) {
  return state == SignalState::kStop || state == SignalState::kStopThenProceed ||
         state == SignalState::kPreMovement;
}

/// Fault of the signals as a whole; empty: they work.
std::string faultOf(const ApproachingHost& host, const std::optional<IntersectionSignals>& signals,
                    const SignalAdviceOptions& options) {
  // DE IntersectionStatusObject: failure flash, failure mode, off, no valid SPAT.
  constexpr std::array<unsigned, 4> kOff = {2, 8, 9, 13};
  // Manual control, time stopped, preemption: the given times may not hold.
  constexpr std::array<unsigned, 3> kIrregular = {0, 1, 3};
  // Lanes have changed, no valid MAP.
  constexpr std::array<unsigned, 2> kMap = {11, 12};
  if (!signals) {
    return "no_signals";
  }
  if (std::abs(secondsBetween(signals->stamp, host.stamp)) > options.max_age) {
    return "old_signals";
  }
  const auto has_any = [&signals](const auto& bits) {
    return std::any_of(bits.begin(), bits.end(),
                       [&signals](unsigned bit) { return signals->state.hasStatus(bit); });
  };
  if (has_any(kOff)) {
    return "signals_off";
  }
  if (has_any(kIrregular)) {
    return "signals_irregular";
  }
  return has_any(kMap) ? "map_not_valid" : "";
}

/// Lanes that the vehicle may be on: the nearest one, and its neighbors if the position is too
/// uncertain.
std::vector<Candidate> lanesOf(const ApproachingHost& host, const std::vector<ApproachLane>& lanes,
                               const SignalAdviceOptions& options) {
  std::vector<Candidate> found;
  for (const ApproachLane& lane : lanes) {
    const LanePosition position = positionOn(lane, host.front);
    const double half = 0.5 * (lane.width > 0.0 ? lane.width : options.lane_width);
    const bool is_on = position.lateral <= half + options.bound * host.position_sigma &&
                       position.distance >= -options.bound * host.position_sigma &&
                       position.outside <= options.bound * host.position_sigma &&
                       position.distance <= options.max_distance;
    if (is_on && std::abs(angleBetween(host.heading, position.heading)) <= options.max_heading) {
      found.push_back({&lane, position});
    }
  }
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.position.lateral < b.position.lateral;
  });
  return found;
}

/// The vehicle's approach to the stop line, with bounds that hold for its whole uncertainty.
struct Approach {
  std::optional<TimeSpan> arrival;  ///< none: it stands still
  bool can_stop = false;            ///< surely
  bool cannot_stop = false;         ///< surely
};

Approach approachOf(const ApproachingHost& host, double distance,
                    const SignalAdviceOptions& options) {
  const double reach = options.bound * host.position_sigma;
  const double slowest = std::max(host.speed - options.bound * host.speed_sigma, 0.0);
  const double fastest = host.speed + options.bound * host.speed_sigma;
  const double nearest = std::max(distance - reach, 0.0);
  const double farthest = std::max(distance, 0.0) + reach;
  const auto stopping = [&options](double speed) {
    return speed * options.reaction_time + speed * speed / (2.0 * options.comfort_deceleration);
  };
  Approach approach;
  if (host.speed >= options.min_speed) {
    approach.arrival = TimeSpan{nearest / fastest - options.time_margin,
                                slowest > 0.0 ? farthest / slowest + options.time_margin : kEver};
  }
  approach.can_stop = stopping(fastest) <= nearest;
  approach.cannot_stop = stopping(slowest) > farthest;
  return approach;
}

/// Whether a signal that shows `state` on arrival lets the vehicle pass, if that is certain.
SignalVerdict verdictOf(SignalState state, const Approach& approach) {
  if (isGreen(state) || (isYellow(state) && approach.cannot_stop)) {
    return SignalVerdict::kPasses;
  }
  return isRed(state) || (isYellow(state) && approach.can_stop) ? SignalVerdict::kMustBrake
                                                                : SignalVerdict::kUnknown;
}

/// Combines the verdicts on all possibilities, one after another, until one differs.
class Agreement {
 public:
  void add(SignalVerdict verdict, SignalState state) {
    verdict_ = !has_any_ || verdict == verdict_ ? verdict : SignalVerdict::kUnknown;
    state_ = !has_any_ || state == state_ ? state : SignalState::kUnavailable;
    has_any_ = true;
  }

  SignalVerdict verdict() const { return verdict_; }
  SignalState state() const { return state_; }

 private:
  bool has_any_ = false;
  SignalVerdict verdict_ = SignalVerdict::kUnknown;
  SignalState state_ = SignalState::kUnavailable;
};

/// Verdict on what a group shows during the arrival interval: each event that may be active then.
Agreement onArrival(const SpatMovement& movement, Stamp reference, Stamp from,
                    const Approach& approach, const SignalAdviceOptions& options) {
  const TimeSpan& arrival = *approach.arrival;
  Agreement agreement;
  TimeSpan before{-kEver, -kEver};  // the first event is active
  for (const SpatEvent& event : movement.events) {
    const bool is_first = &event == &movement.events.front();
    const EventStart start = startOf(event, before, is_first, reference, from);
    if (arrival.last >= before.first && arrival.first <= start.gap_end) {
      agreement.add(SignalVerdict::kUnknown, SignalState::kUnavailable);
    }
    TimeSpan end = endOf(event, reference, from);
    end.first = std::max(end.first, start.span.first);
    end.last = std::max(end.last, start.span.last);
    if (arrival.last >= start.span.first && arrival.first <= end.last) {
      agreement.add(verdictOf(event.state, approach), event.state);
    }
    before = end;
  }
  if (arrival.last >= before.first) {
    // After the last given event. Green is followed by yellow and red, for at least some seconds.
    const bool was_green = isGreen(movement.events.back().state);
    const bool is_red_yet = was_green && arrival.last <= before.first + options.stop_time;
    agreement.add(
        is_red_yet && approach.can_stop ? SignalVerdict::kMustBrake : SignalVerdict::kUnknown,
        SignalState::kUnavailable);
  }
  return agreement;
}

MovementAdvice adviseMovement(const ApproachingHost& host, const IntersectionSignals& signals,
                              const SpatMovement& movement, const Approach& approach,
                              const SignalAdviceOptions& options) {
  MovementAdvice advice;
  advice.group = movement.group;
  const SpatEvent& first = movement.events.front();
  advice.now = first.state;
  if (first.timing) {
    advice.min_end = secondsTo(first.timing->min_end, signals.stamp, host.stamp, kLongPast);
    advice.max_end = secondsTo(first.timing->max_end, signals.stamp, host.stamp);
    advice.likely_end = secondsTo(first.timing->likely, signals.stamp, host.stamp, kLongPast);
  }
  if (approach.arrival) {
    const Agreement agreement = onArrival(movement, signals.stamp, host.stamp, approach, options);
    advice.verdict = agreement.verdict();
    advice.on_arrival = agreement.state();
  }
  return advice;
}

void adviseLane(const ApproachingHost& host, const Candidate& candidate,
                const IntersectionSignals& signals, const SignalAdviceOptions& options,
                SignalAdvice& advice) {
  const Approach approach = approachOf(host, candidate.position.distance, options);
  const auto& movements = signals.state.movements;
  if (candidate.lane->groups.empty()) {
    MovementAdvice unknown;
    unknown.lane = candidate.lane->id;
    advice.movements.push_back(unknown);
  }
  for (const std::int64_t group : candidate.lane->groups) {
    const auto found = std::find_if(movements.begin(), movements.end(),
                                    [group](const auto& one) { return one.group == group; });
    MovementAdvice movement;
    if (group != kNoGroup && found != movements.end() && !found->events.empty()) {
      movement = adviseMovement(host, signals, *found, approach, options);
    }
    movement.group = group;
    movement.lane = candidate.lane->id;
    advice.movements.push_back(movement);
  }
}

/// Sets the common verdict of all movements, or why there is none.
void agree(const ApproachingHost& host, const SignalAdviceOptions& options, SignalAdvice& advice) {
  const auto& movements = advice.movements;
  const auto is_known = [](const MovementAdvice& one) {
    return one.verdict != SignalVerdict::kUnknown;
  };
  if (std::any_of(movements.begin(), movements.end(),
                  [](const MovementAdvice& one) { return one.group == kNoGroup; })) {
    advice.reason = "no_signal_group";
  } else if (host.speed < options.min_speed) {
    advice.reason = "standing";
  } else if (!std::all_of(movements.begin(), movements.end(), is_known)) {
    advice.reason = "not_known_on_arrival";
  } else if (std::any_of(movements.begin(), movements.end(), [&](const MovementAdvice& one) {
               return one.verdict != movements.front().verdict;
             })) {
    advice.reason = "groups_differ";
  } else {
    advice.verdict = movements.front().verdict;
  }
}

}  // namespace

std::optional<SignalAdvice> adviseSignals(const ApproachingHost& host,
                                          const std::vector<ApproachLane>& lanes,
                                          const std::optional<IntersectionSignals>& signals,
                                          const SignalAdviceOptions& options) {
  const std::vector<Candidate> candidates = lanesOf(host, lanes, options);
  if (candidates.empty()) {
    return std::nullopt;
  }
  SignalAdvice advice;
  advice.distance = candidates.front().position.distance;
  if (host.speed >= options.min_speed) {
    advice.arrival = std::max(advice.distance, 0.0) / host.speed;
  }
  constexpr double kAtLine = 0.1;  // m
  advice.deceleration = host.speed * host.speed / (2.0 * std::max(advice.distance, kAtLine));
  advice.reason = host.position_sigma > options.max_position_sigma
                      ? "position_uncertain"
                      : faultOf(host, signals, options);
  if (advice.reason.empty()) {
    for (const Candidate& candidate : candidates) {
      adviseLane(host, candidate, *signals, options, advice);
    }
    agree(host, options, advice);
  }
  return advice;
}

}  // namespace datmo
