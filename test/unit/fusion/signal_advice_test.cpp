// SPDX-License-Identifier: BSD-3-Clause
// Whether the vehicle passes a light at its speed: cases by hand, and an approach with known truth.
#include "datmo_fusion/fusion/earth/signal_advice.h"

#include <cmath>

#include "lights_ahead.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo {
namespace {

using samples::kHourStart;

class SignalAdviceTest : public samples::LightsAhead {};

TEST_F(SignalAdviceTest, GreenThatLastsPasses) {
  show({event(SignalState::kProtected, 12.0, 20.0)});
  const SignalAdvice advice = *advise();
  EXPECT_EQ(advice.verdict, SignalVerdict::kPasses);
  EXPECT_NEAR(advice.distance, 100.0, 1e-9);
  EXPECT_NEAR(*advice.arrival, 10.0, 1e-9);
  EXPECT_NEAR(advice.deceleration, 0.5, 1e-9);
  ASSERT_EQ(advice.movements.size(), 1U);
  EXPECT_EQ(advice.movements[0].lane, 5);
  EXPECT_EQ(advice.movements[0].group, 3);
  EXPECT_EQ(advice.movements[0].now, SignalState::kProtected);
  EXPECT_EQ(advice.movements[0].on_arrival, SignalState::kProtected);
  EXPECT_NEAR(*advice.movements[0].min_end, 12.0, 1e-6);
  EXPECT_NEAR(*advice.movements[0].max_end, 20.0, 1e-6);
}

TEST_F(SignalAdviceTest, GreenThatMayEndBeforeIsNotKnown) {
  show({event(SignalState::kProtected, 8.0, 20.0)});
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
  EXPECT_EQ(advise()->reason, "not_known_on_arrival");
  EXPECT_EQ(advise()->movements[0].on_arrival, SignalState::kUnavailable);
}

TEST_F(SignalAdviceTest, GreenThatEndsBeforeIsNoLongerGreen) {
  show({event(SignalState::kPermissive, 7.0, 8.0)});
  EXPECT_EQ(verdict(), SignalVerdict::kMustBrake);
  // A minute later it may be green again.
  host_.speed = 100.0 / 60.0;
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
}

TEST_F(SignalAdviceTest, RedThatLastsMustBrake) {
  show({event(SignalState::kStop, 11.0, 30.0)});
  EXPECT_EQ(verdict(), SignalVerdict::kMustBrake);
  EXPECT_EQ(advise()->movements[0].on_arrival, SignalState::kStop);
}

TEST_F(SignalAdviceTest, YellowPassesOnlyWhereItCannotStop) {
  show({event(SignalState::kProtectedClearance, 12.0, 12.0)});
  EXPECT_EQ(verdict(), SignalVerdict::kMustBrake);
  host_.front.x() = -20.0;  // 2 s; it needs 10 m + 16.7 m to stop
  EXPECT_EQ(verdict(), SignalVerdict::kPasses);
  for (const double distance : {26.3, 27.0}) {  // 0.4 m more or less matter
    host_.front.x() = -distance;
    EXPECT_EQ(verdict(), SignalVerdict::kUnknown) << distance;
  }
  host_.front.x() = -27.2;
  EXPECT_EQ(verdict(), SignalVerdict::kMustBrake);
  host_.speed_sigma = 0.2;  // by up to 1.8 m
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
}

TEST_F(SignalAdviceTest, SpeedUncertaintyCountsForTheArrival) {
  show({event(SignalState::kProtected, 12.0, 20.0)});
  host_.speed_sigma = 0.5;  // 9 m/s to 11 m/s: up to 11.2 s and the margin
  EXPECT_EQ(verdict(), SignalVerdict::kPasses);
  host_.speed_sigma = 0.8;
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
  host_.speed_sigma = 6.0;  // it may be stationary
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
}

TEST_F(SignalAdviceTest, BothLanesCountIfThePositionIsUncertain) {
  show({event(SignalState::kProtected, 30.0, 30.0)});
  show({event(SignalState::kStop, 30.0, 30.0)}, 4);
  EXPECT_EQ(verdict(), SignalVerdict::kPasses);
  host_.position_sigma = 1.5;
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
  EXPECT_EQ(advise()->reason, "groups_differ");
  EXPECT_EQ(advise()->movements.size(), 2U);
  signals_->state.movements[1].events = signals_->state.movements[0].events;
  EXPECT_EQ(verdict(), SignalVerdict::kPasses);
  lanes_[1].groups.clear();  // without lights
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
  EXPECT_EQ(advise()->reason, "no_signal_group");
  EXPECT_EQ(advise()->movements.size(), 2U);
  lanes_[1].groups = {4};
  host_.position_sigma = 6.0;
  EXPECT_EQ(advise()->reason, "position_uncertain");
}

TEST_F(SignalAdviceTest, GroupsOfOneLaneThatDifferGiveNoVerdict) {
  lanes_[0].groups = {3, 4};
  show({event(SignalState::kProtected, 30.0, 30.0)});
  show({event(SignalState::kStop, 30.0, 30.0)}, 4);
  EXPECT_EQ(advise()->reason, "groups_differ");
  lanes_[0].groups = {3, 9};  // for which nothing is given
  EXPECT_EQ(advise()->reason, "not_known_on_arrival");
  lanes_[0].groups.clear();
  EXPECT_EQ(advise()->reason, "no_signal_group");
}

TEST_F(SignalAdviceTest, OffTheLanesThereIsNoAdvice) {
  show({event(SignalState::kProtected, 30.0, 30.0)});
  host_.heading = kPi;  // away from it
  EXPECT_FALSE(advise());
  host_.heading = 0.0;
  host_.front = {-100.0, -10.0};
  EXPECT_FALSE(advise());
  host_.front = {-201.0, 0.0};  // before the known part of it
  EXPECT_FALSE(advise());
  host_.front = {5.0, 0.0};  // past the line
  EXPECT_FALSE(advise());
  host_.front = {-100.0, 0.0};
  options_.max_distance = 90.0;
  EXPECT_FALSE(advise());
}

TEST_F(SignalAdviceTest, OldDisabledOrMissingLightsGiveNoAdvice) {
  show({event(SignalState::kProtected, 30.0, 30.0)});
  const IntersectionSignals good = *signals_;
  signals_->stamp = host_.stamp + -2.1;
  EXPECT_EQ(advise()->reason, "old_signals");
  signals_ = good;
  const auto reason_of = [this](unsigned bit) {
    signals_->state.status = 0x8000 >> bit;
    return advise()->reason;
  };
  for (const unsigned bit : {2U, 8U, 9U, 13U}) {
    EXPECT_EQ(reason_of(bit), "signals_off") << bit;
  }
  for (const unsigned bit : {0U, 1U, 3U}) {  // by hand, time stopped, preempted
    EXPECT_EQ(reason_of(bit), "signals_irregular") << bit;
  }
  for (const unsigned bit : {11U, 12U}) {
    EXPECT_EQ(reason_of(bit), "map_not_valid") << bit;
  }
  for (const unsigned bit : {4U, 5U, 6U, 7U, 10U}) {
    EXPECT_EQ(reason_of(bit), "") << bit;
  }
  signals_.reset();
  EXPECT_EQ(advise()->reason, "no_signals");
  signals_ = good;
  host_.speed = 0.2;
  EXPECT_EQ(advise()->reason, "standing");
  EXPECT_FALSE(advise()->arrival);
  EXPECT_EQ(advise()->movements[0].now, SignalState::kProtected);
}

/// A light of a fixed cycle: green, yellow, red, red and yellow.
struct Cycle {
  double offset = 0.0;  ///< s
  static constexpr double kGreen = 20.0;
  static constexpr double kYellow = 3.0;
  static constexpr double kRed = 35.0;
  static constexpr double kRedYellow = 2.0;
  static constexpr double kPeriod = kGreen + kYellow + kRed + kRedYellow;

  /// At a time of the hour (s): state and its end.
  std::pair<SignalState, double> at(double time) const {
    const double phase = std::fmod(time + offset, kPeriod);
    const double start = time - phase;
    if (phase < kGreen) {
      return {SignalState::kProtected, start + kGreen};
    }
    if (phase < kGreen + kYellow) {
      return {SignalState::kProtectedClearance, start + kGreen + kYellow};
    }
    if (phase < kGreen + kYellow + kRed) {
      return {SignalState::kStop, start + kGreen + kYellow + kRed};
    }
    return {SignalState::kPreMovement, start + kPeriod};
  }
};

/// Approaches at constant speed with each offset of the cycle: the advice is what is then observed,
/// from the first time at which there is advice.
TEST_F(SignalAdviceTest, OnSimulatedApproachesTheAdviceIsCorrect) {
  int said = 0;
  int passes = 0;
  int not_said = 0;
  for (double offset = 0.0; offset < Cycle::kPeriod; offset += 1.0) {
    const Cycle cycle{offset};
    const double arrival = 120.0 + 190.0 / 13.0;
    const SignalState truth = cycle.at(arrival).first;
    for (double time = 120.0; time < arrival; time += 0.5) {
      host_.stamp = Stamp::fromSeconds(kHourStart + time);
      host_.speed = 13.0;
      host_.front = {-190.0 + 13.0 * (time - 120.0), 0.0};
      signals_ = IntersectionSignals{host_.stamp, {}};
      SpatMovement movement{3, {}};
      double event_time = time;
      for (int i = 0; i < 3; ++i) {  // this one and the next two
        const auto [state, end] = cycle.at(event_time);
        SpatTiming timing;
        timing.min_end = std::llround(10.0 * end);
        timing.max_end = timing.min_end;
        movement.events.push_back({state, timing});
        event_time = end + 0.01;
      }
      signals_->state.movements = {movement};
      const SignalAdvice advice = advise().value();
      if (advice.verdict == SignalVerdict::kPasses) {
        EXPECT_TRUE(truth == SignalState::kProtected || truth == SignalState::kProtectedClearance)
            << offset << " " << time;
        ++passes;
      } else if (advice.verdict == SignalVerdict::kMustBrake) {
        EXPECT_NE(truth, SignalState::kProtected) << offset << " " << time;
      }
      advice.verdict == SignalVerdict::kUnknown ? ++not_said : ++said;
    }
  }
  // There is no advice for changes within 0.5 s of the arrival and 0.4 m of the position, before or
  // after: about a second at two of the changes per minute.
  EXPECT_GT(passes, 400);
  EXPECT_GT(said, 15 * not_said);
}

}  // namespace
}  // namespace datmo
