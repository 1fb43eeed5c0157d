// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/signal_advice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/fusion/earth/signal_times.h"

namespace datmo {

namespace {

constexpr double kEver = std::numeric_limits<double>::infinity();

/// From the first to the last time that is possible, s after the host's stamp.
struct TimeSpan {
  double first = 0.0;
  double last = 0.0;
};

struct Candidate {
  const ApproachLane* lane = nullptr;
  LanePlace place;
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

/// Of the lights as a whole; empty: they work.
std::string faultOf(const ApproachingHost& host, const std::optional<IntersectionSignals>& signals,
                    const SignalAdviceOptions& options) {
  constexpr unsigned kFailureFlash = 2;
  constexpr unsigned kFailureMode = 8;
  constexpr unsigned kOff = 9;
  constexpr unsigned kNoSpat = 13;
  if (!signals) {
    return "no_signals";
  }
  if (std::abs(secondsBetween(signals->stamp, host.stamp)) > options.max_age) {
    return "old_signals";
  }
  const SpatIntersection& state = signals->state;
  const bool fails = state.hasStatus(kFailureFlash) || state.hasStatus(kFailureMode) ||
                     state.hasStatus(kOff) || state.hasStatus(kNoSpat);
  return fails ? "signals_off" : "";
}

/// Lanes that the vehicle may be on: the nearest one's neighbors, too, if the place is not known
/// well enough.
std::vector<Candidate> lanesOf(const ApproachingHost& host, const std::vector<ApproachLane>& lanes,
                               const SignalAdviceOptions& options) {
  std::vector<Candidate> found;
  for (const ApproachLane& lane : lanes) {
    const LanePlace place = placeOn(lane, host.front);
    const double half = 0.5 * (lane.width > 0.0 ? lane.width : options.lane_width);
    const bool is_on = place.lateral <= half + options.bound * host.position_sigma &&
                       place.distance >= -options.bound * host.position_sigma &&
                       place.outside <= options.bound * host.position_sigma &&
                       place.distance <= options.max_distance;
    if (is_on && std::abs(angleBetween(host.heading, place.heading)) <= options.max_heading) {
      found.push_back({&lane, place});
    }
  }
  std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.place.lateral < b.place.lateral;
  });
  return found;
}

std::optional<double> secondsTo(const std::optional<std::int64_t>& mark, Stamp reference,
                                Stamp from) {
  const std::optional<Stamp> time = stampOfMark(mark, reference);
  return time ? std::optional<double>(secondsBetween(from, *time)) : std::nullopt;
}

/// When an event ends: what is not told may be any time.
TimeSpan endOf(const SpatEvent& event, Stamp reference, Stamp from) {
  if (!event.timing) {
    return {-kEver, kEver};
  }
  const double first = secondsTo(event.timing->min_end, reference, from).value_or(-kEver);
  const double last = secondsTo(event.timing->max_end, reference, from).value_or(kEver);
  return {first, std::max(first, last)};
}

/// Whether it can be said that a light that shows `state` when the vehicle comes lets it pass.
SignalVerdict verdictOf(SignalState state, bool can_stop) {
  if (isGreen(state) || (isYellow(state) && !can_stop)) {
    return SignalVerdict::kPasses;
  }
  return isYellow(state) || isRed(state) ? SignalVerdict::kMustBrake : SignalVerdict::kUnknown;
}

/// Verdicts on what may be, one after the other, until one differs.
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

/// What a group shows while the vehicle may come: each event that may be on then.
Agreement onArrival(const SpatMovement& movement, Stamp reference, Stamp from,
                    const TimeSpan& arrival, bool can_stop, const SignalAdviceOptions& options) {
  Agreement agreement;
  TimeSpan start{-kEver, -kEver};  // the first event is on
  for (const SpatEvent& event : movement.events) {
    TimeSpan end = endOf(event, reference, from);
    end.first = std::max(end.first, start.first);
    end.last = std::max(end.last, start.last);
    if (arrival.last >= start.first && arrival.first <= end.last) {
      agreement.add(verdictOf(event.state, can_stop), event.state);
    }
    start = end;
  }
  if (arrival.last >= start.first) {
    // Behind the events that are told. After green come yellow and red, for some seconds at least.
    const bool was_green = isGreen(movement.events.back().state);
    const bool is_red_yet = was_green && arrival.last <= start.first + options.stop_time;
    agreement.add(is_red_yet && can_stop ? SignalVerdict::kMustBrake : SignalVerdict::kUnknown,
                  SignalState::kUnavailable);
  }
  return agreement;
}

MovementAdvice adviseMovement(const ApproachingHost& host, const IntersectionSignals& signals,
                              const SpatMovement& movement, const std::optional<TimeSpan>& arrival,
                              bool can_stop, const SignalAdviceOptions& options) {
  MovementAdvice advice;
  advice.group = movement.group;
  const SpatEvent& first = movement.events.front();
  advice.now = first.state;
  if (first.timing) {
    advice.min_end = secondsTo(first.timing->min_end, signals.stamp, host.stamp);
    advice.max_end = secondsTo(first.timing->max_end, signals.stamp, host.stamp);
    advice.likely_end = secondsTo(first.timing->likely, signals.stamp, host.stamp);
  }
  if (arrival) {
    const Agreement agreement =
        onArrival(movement, signals.stamp, host.stamp, *arrival, can_stop, options);
    advice.verdict = agreement.verdict();
    advice.on_arrival = agreement.state();
  }
  return advice;
}

void adviseLane(const ApproachingHost& host, const Candidate& candidate,
                const IntersectionSignals& signals, const SignalAdviceOptions& options,
                SignalAdvice& advice) {
  const double distance = std::max(candidate.place.distance, 0.0);
  const double reach = options.bound * host.position_sigma;
  std::optional<TimeSpan> arrival;
  if (host.speed >= options.min_speed) {
    arrival = TimeSpan{std::max(distance - reach, 0.0) / host.speed - options.time_margin,
                       (distance + reach) / host.speed + options.time_margin};
  }
  const double stopping = host.speed * options.reaction_time +
                          host.speed * host.speed / (2.0 * options.comfort_deceleration);
  const bool can_stop = stopping <= distance;
  for (const std::int64_t group : candidate.lane->groups) {
    const auto& movements = signals.state.movements;
    const auto found = std::find_if(movements.begin(), movements.end(),
                                    [group](const auto& one) { return one.group == group; });
    MovementAdvice movement;
    if (found != movements.end() && !found->events.empty()) {
      movement = adviseMovement(host, signals, *found, arrival, can_stop, options);
    }
    movement.group = group;
    movement.lane = candidate.lane->id;
    advice.movements.push_back(movement);
  }
}

/// The verdict of all movements, and why there is none.
void agree(const ApproachingHost& host, const SignalAdviceOptions& options, SignalAdvice& advice) {
  const auto& movements = advice.movements;
  const auto is_known = [](const MovementAdvice& one) {
    return one.verdict != SignalVerdict::kUnknown;
  };
  if (movements.empty()) {
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

void SignalAdviceOptions::visit(OptionVisitor& visitor) {
  visitor.number({"max_distance", "m", "to the stop line; V2X reaches 300 m to 500 m in cities"},
                 max_distance, {10.0, 2000.0});
  visitor.number({"max_heading", "rad", "between the vehicle and its lane"}, max_heading,
                 {0.05, 1.5});
  visitor.number({"lane_width", "m", "of an intersection that does not say it"}, lane_width,
                 {1.0, 10.0});
  visitor.number({"max_position_sigma", "m",
                  "standard deviation of the vehicle's place on the earth, above which there is no "
                  "advice: a lane and a half"},
                 max_position_sigma, {0.1, 50.0});
  visitor.number({"bound", "1", "standard deviations within which the vehicle is taken to be"},
                 bound, {0.0, 5.0});
  visitor.number({"time_margin", "s", "before and after the arrival, for clocks and for the speed"},
                 time_margin, {0.0, 5.0});
  visitor.number({"stop_time", "s",
                  "for which yellow and red last at least after green whose next lights are not "
                  "told: 3 s of yellow at 50 km/h and a red of some seconds (RiLSA 2015)"},
                 stop_time, {0.0, 60.0});
  visitor.number({"comfort_deceleration", "m/s^2",
                  "with which the vehicle stops at yellow if it can (ITE: 3.05)"},
                 comfort_deceleration, {0.5, 10.0});
  visitor.number({"reaction_time", "s", "before it brakes (ITE: 1)"}, reaction_time, {0.0, 3.0});
  visitor.number({"min_speed", "m/s", "a slower vehicle stands: it never arrives"}, min_speed,
                 {0.1, 5.0});
  visitor.number({"max_age", "s",
                  "of lights: older ones say nothing (ETSI TS 103 301: sent each 0.1 s to 1 s)"},
                 max_age, {0.1, 60.0});
}

std::optional<SignalAdvice> adviseSignals(const ApproachingHost& host,
                                          const std::vector<ApproachLane>& lanes,
                                          const std::optional<IntersectionSignals>& signals,
                                          const Checked<SignalAdviceOptions>& options) {
  const std::vector<Candidate> candidates = lanesOf(host, lanes, *options);
  if (candidates.empty()) {
    return std::nullopt;
  }
  SignalAdvice advice;
  advice.distance = candidates.front().place.distance;
  if (host.speed >= options->min_speed) {
    advice.arrival = std::max(advice.distance, 0.0) / host.speed;
  }
  constexpr double kAtLine = 0.1;  // m
  advice.deceleration = host.speed * host.speed / (2.0 * std::max(advice.distance, kAtLine));
  advice.reason = host.position_sigma > options->max_position_sigma
                      ? "position_uncertain"
                      : faultOf(host, signals, *options);
  if (advice.reason.empty()) {
    for (const Candidate& candidate : candidates) {
      adviseLane(host, candidate, *signals, *options, advice);
    }
    agree(host, *options, advice);
  }
  return advice;
}

}  // namespace datmo
