// SPDX-License-Identifier: BSD-3-Clause
// SPATEM, MAPEM and our own position to advice; stale, repeated or broken messages are counted.
#include "datmo_fusion/ros/signal_wire.h"

#include <cmath>

#include "../fusion/signal_messages.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {
namespace {

/// 2026-01-01 00:00:00 UTC, when a minute of the year is 0 and an hour begins.
const Stamp kNewYear = Stamp::fromSeconds(1767225600.0);

class SignalWireTest : public testing::Test {
 protected:
  /// Green of group 3 until `end` (s), given at `seconds`.
  static std::string spatem(double seconds, double end) {
    Spatem message = samples::spatem();
    SpatIntersection& intersection = message.intersections[0];
    intersection.id = {std::nullopt, 3456};
    intersection.status = 0;
    intersection.minute = static_cast<std::int64_t>(seconds) / 60;
    intersection.millisecond = std::llround(1000.0 * std::fmod(seconds, 60.0));
    SpatTiming timing;
    timing.min_end = std::llround(10.0 * end);
    timing.max_end = timing.min_end;
    intersection.movements[0].events = {{SignalState::kProtected, timing}};
    return encode(message);
  }

  /// The sample's lane 5: its stop line 5 m east and 2 m south of the reference point, the first
  /// 20 m from there to the east.
  static std::string mapem() { return encode(samples::mapem()); }

  /// We drive west on it at 10 m/s, with the front 20 m before the line; 4 m long.
  static StationTracksMessage ownAt(double seconds) {
    const LocalPlane plane({degrees(45.19), degrees(5.72), 0.0});
    StationTrackList list;
    list.stamp = kNewYear + seconds;
    StationTrack own;
    own.position = {5.0 + 20.0 + 2.0, -2.0};
    own.velocity = {-10.0, 0.0};
    own.heading = kPi;
    own.length = 4.0;
    own.covariance *= 0.01;
    list.tracks.push_back(own);
    return toMessage(list, plane);
  }

  StageMonitor monitor_{"v2x_wire"};
  SignalWire wire_{SignalWireOptions(), monitor_};
};

TEST_F(SignalWireTest, LightsAndAMapGiveAdvice) {
  EXPECT_TRUE(SignalWire::accepts(mapem()));
  EXPECT_TRUE(SignalWire::accepts(spatem(100.0, 130.0)));
  EXPECT_FALSE(SignalWire::accepts(""));
  EXPECT_FALSE(SignalWire::accepts("\x02\x02"));
  EXPECT_FALSE(wire_.advise(ownAt(100.0)));
  wire_.received(mapem(), kNewYear + 99.0);
  SignalAdviceMessagePtr advice = wire_.advise(ownAt(100.0));
  ASSERT_TRUE(advice);
  EXPECT_EQ(advice->verdict, SignalAdviceMessage::UNKNOWN);
  EXPECT_EQ(advice->reason, "no_signals");
  wire_.received(spatem(100.0, 130.0), kNewYear + 100.05);
  advice = wire_.advise(ownAt(100.1));
  ASSERT_TRUE(advice);
  EXPECT_EQ(toStamp(advice->header.stamp), kNewYear + 100.1);
  EXPECT_EQ(advice->verdict, SignalAdviceMessage::PASSES);
  EXPECT_EQ(advice->intersection, 3456);
  EXPECT_NEAR(advice->distance, 20.0, 0.01);
  EXPECT_NEAR(advice->arrival, 2.0, 0.001);
  EXPECT_NEAR(advice->deceleration, 2.5, 0.01);
  ASSERT_EQ(advice->movements.size(), 1U);
  EXPECT_EQ(advice->movements[0].lane, 5);
  EXPECT_EQ(advice->movements[0].state, datmo_fusion::SignalMovement::PROTECTED);
  EXPECT_NEAR(advice->movements[0].max_end, 29.9, 1e-6);
  EXPECT_TRUE(std::isnan(advice->movements[0].likely_end));
  EXPECT_EQ(monitor_.figures().at("intersections with a map"), 1.0);
}

TEST_F(SignalWireTest, AnUnusableLaneLeavesNoVerdict) {
  Mapem map = samples::mapem();
  map.intersections[0].lanes[1].computed->reference = 99;  // there is none
  wire_.received(encode(map), kNewYear + 99.0);
  wire_.received(spatem(100.0, 130.0), kNewYear + 100.0);
  const SignalAdviceMessagePtr advice = wire_.advise(ownAt(100.0));
  ASSERT_TRUE(advice);
  EXPECT_EQ(advice->verdict, SignalAdviceMessage::UNKNOWN);
  EXPECT_EQ(advice->reason, "lanes_left_out");
  EXPECT_EQ(samples::warnings(monitor_, "lanes_left_out"), 1U);
}

TEST_F(SignalWireTest, AnUncertainSpeedLeavesNoVerdict) {
  wire_.received(mapem(), kNewYear + 99.0);
  wire_.received(spatem(100.0, 103.0), kNewYear + 100.0);
  StationTracksMessage own = ownAt(100.0);
  EXPECT_EQ(wire_.advise(own)->verdict, SignalAdviceMessage::PASSES);
  own.tracks[0].covariance[10] = 9.0;  // of the velocity to the east
  EXPECT_EQ(wire_.advise(own)->reason, "not_known_on_arrival");
}

TEST_F(SignalWireTest, StaleFutureRepeatedAndBrokenMessagesAreCounted) {
  wire_.received(spatem(100.0, 130.0), kNewYear + 102.5);
  EXPECT_EQ(samples::drops(monitor_, "old_signals"), 1U);
  wire_.received(spatem(103.5, 130.0), kNewYear + 102.6);
  EXPECT_EQ(samples::drops(monitor_, "future_signals"), 1U);
  wire_.received(spatem(103.0, 130.0), kNewYear + 103.0);
  wire_.received(spatem(103.0, 130.0), kNewYear + 103.1);
  wire_.received(spatem(102.9, 130.0), kNewYear + 103.2);
  EXPECT_EQ(samples::drops(monitor_, "repeated_signals"), 2U);
  wire_.received(mapem().substr(0, 20), kNewYear + 103.3);
  EXPECT_EQ(samples::drops(monitor_, "truncated_message"), 1U);
  std::string other = mapem();
  other[0] = 1;
  wire_.received(other, kNewYear + 103.4);
  EXPECT_EQ(samples::drops(monitor_, "other_version"), 1U);
  EXPECT_FALSE(wire_.advise(ownAt(103.5)));
}

TEST_F(SignalWireTest, LostLightsGiveNoAdviceAndMapsAreForgotten) {
  wire_.received(mapem(), kNewYear + 100.0);
  wire_.received(spatem(100.0, 130.0), kNewYear + 100.0);
  EXPECT_EQ(wire_.advise(ownAt(102.1))->reason, "old_signals");
  EXPECT_FALSE(wire_.advise(ownAt(160.1)));
}

TEST_F(SignalWireTest, ATimeJumpBackStartsOver) {
  wire_.received(mapem(), kNewYear + 200.0);
  wire_.received(spatem(200.0, 230.0), kNewYear + 200.0);
  wire_.received(spatem(100.0, 130.0), kNewYear + 100.0);
  EXPECT_FALSE(wire_.advise(ownAt(100.0)));
  wire_.received(mapem(), kNewYear + 100.1);
  EXPECT_EQ(wire_.advise(ownAt(100.1))->verdict, SignalAdviceMessage::PASSES);
}

TEST_F(SignalWireTest, AClockThatIsCorrectedForgetsNoMap) {
  wire_.received(mapem(), kNewYear + 100.0);
  wire_.received(spatem(99.5, 130.0), kNewYear + 99.5);
  EXPECT_EQ(wire_.advise(ownAt(99.5))->verdict, SignalAdviceMessage::PASSES);
}

TEST_F(SignalWireTest, WithoutOurselvesThereIsNoAdvice) {
  wire_.received(mapem(), kNewYear + 100.0);
  StationTracksMessage own = ownAt(100.0);
  own.tracks[0].latitude = std::nan("");
  EXPECT_FALSE(wire_.advise(own));
  own = ownAt(100.0);
  own.tracks[0].id = 7;
  EXPECT_FALSE(wire_.advise(own));
}

}  // namespace
}  // namespace datmo
