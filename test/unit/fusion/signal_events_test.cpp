// SPDX-License-Identifier: BSD-3-Clause
// The state of a group of lights on arrival, by its events: the given ones, and those between and
// after them.
#include "lights_ahead.h"
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/earth/signal_advice.h"

namespace datmo {
namespace {

class SignalEventsTest : public samples::LightsAhead {};

/// `start`: s after the host's stamp.
SpatEvent startingAt(double start, SpatEvent event) {
  event.timing->start = std::llround(10.0 * (100.0 + start));
  return event;
}

TEST_F(SignalEventsTest, AnEndFarAheadIsNotPast) {
  host_.front.x() = -130.0;
  for (const double minutes : {31.0, 40.0, 58.0}) {
    signals_->state.movements.clear();
    show({event(SignalState::kStop, 10.0, 60.0 * minutes),
          event(SignalState::kProtected, 60.0 * minutes, 60.0 * minutes)});
    EXPECT_EQ(verdict(), SignalVerdict::kUnknown) << minutes;
  }
  signals_->state.movements.clear();
  show({event(SignalState::kStop, 10.0, 5.0), event(SignalState::kProtected, 30.0, 40.0)});
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);  // ends in the wrong order
}

TEST_F(SignalEventsTest, AnEndedEventSentAsActiveIsUnknown) {
  show({event(SignalState::kStop, -5.0, -5.0), event(SignalState::kProtected, 30.0, 40.0)});
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
  EXPECT_NEAR(*advise()->movements[0].min_end, -5.0, 1e-6);  // not an hour ahead
}

TEST_F(SignalEventsTest, TheTimeBetweenTwoEventsIsUnknown) {
  host_.speed = 4.0;  // 25 s to go
  const SpatEvent red = event(SignalState::kStop, 20.0, 20.0);
  const SpatEvent green = event(SignalState::kProtected, 50.0, 50.0);
  show({red, startingAt(30.0, green)});
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
  signals_->state.movements[0].events[1] = startingAt(20.1, green);  // rounded
  EXPECT_EQ(verdict(), SignalVerdict::kPasses);
}

TEST_F(SignalEventsTest, AFirstEventThatHasNotBegunIsNotActive) {
  const SpatEvent green = event(SignalState::kProtected, 50.0, 50.0);
  show({startingAt(30.0, green)});
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
  signals_->state.movements[0].events[0] = startingAt(-90.0, green);
  EXPECT_EQ(verdict(), SignalVerdict::kPasses);
}

TEST_F(SignalEventsTest, FollowingEventsAreUsedIfSent) {
  show({event(SignalState::kStop, 5.0, 5.0), event(SignalState::kPreMovement, 7.0, 7.0),
        event(SignalState::kProtected, 30.0, 40.0)});
  EXPECT_EQ(verdict(), SignalVerdict::kPasses);
  EXPECT_EQ(advise()->movements[0].on_arrival, SignalState::kProtected);
  host_.speed = 100.0 / 6.0;  // at red and yellow
  EXPECT_EQ(verdict(), SignalVerdict::kMustBrake);
  host_.speed = 100.0 / 7.2;  // when that ends
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
}

TEST_F(SignalEventsTest, AfterRedWithoutNextEventItIsUnknown) {
  show({event(SignalState::kStop, 5.0, 6.0)});
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
}

TEST_F(SignalEventsTest, EndsThatAreNotSentAreAnyTime) {
  show({event(SignalState::kProtected, 12.0, unknown_)});
  EXPECT_EQ(verdict(), SignalVerdict::kPasses);
  signals_->state.movements.clear();
  show({event(SignalState::kProtected, unknown_, 12.0)});
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
  signals_->state.movements.clear();
  show({{SignalState::kStop, std::nullopt}});
  EXPECT_EQ(verdict(), SignalVerdict::kUnknown);
}

}  // namespace
}  // namespace datmo
