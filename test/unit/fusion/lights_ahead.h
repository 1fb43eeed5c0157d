// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <gtest/gtest.h>

#include "datmo_fusion/fusion/earth/signal_advice.h"

namespace datmo::samples {

constexpr double kHourStart = 1704067200.0;  // s, a whole hour

/// A lane of 200 m from the west, whose stop line is at the origin, with group 3; to the left of it
/// one with group 4.
class LightsAhead : public testing::Test {
 protected:
  LightsAhead() {
    ApproachLane lane;
    lane.id = 5;
    lane.points = {{0.0, 0.0}, {-200.0, 0.0}};
    lane.width = 3.5;
    lane.groups = {3};
    lanes_.push_back(lane);
    lane.id = 6;
    lane.points = {{0.0, 3.5}, {-200.0, 3.5}};
    lane.groups = {4};
    lanes_.push_back(lane);
    host_.stamp = Stamp::fromSeconds(kHourStart + 100.0);
    host_.front = {-100.0, 0.3};
    host_.speed = 10.0;  // 10 s to go
    host_.position_sigma = 0.2;
    signals_ = IntersectionSignals{host_.stamp, {}};
  }

  /// `first`, `last`: s after the host's stamp; NaN: not known.
  SpatEvent event(SignalState state, double first, double last) const {
    const auto mark = [](double seconds) {
      return std::isnan(seconds) ? SpatTiming::kUnknown : std::llround(10.0 * (100.0 + seconds));
    };
    SpatTiming timing;
    timing.min_end = mark(first);
    timing.max_end = mark(last);
    return {state, timing};
  }

  void show(std::vector<SpatEvent> events, std::int64_t group = 3) {
    signals_->state.movements.push_back({group, std::move(events)});
  }

  std::optional<SignalAdvice> advise() const {
    return adviseSignals(host_, lanes_, signals_, options_);
  }

  SignalVerdict verdict() const { return advise().value().verdict; }

  std::vector<ApproachLane> lanes_;
  ApproachingHost host_;
  std::optional<IntersectionSignals> signals_;
  SignalAdviceOptions options_;
  const double unknown_ = std::nan("");
};

}  // namespace datmo::samples
