// SPDX-License-Identifier: BSD-3-Clause
// SPATEM and MAPEM: bits by hand, round trip, skipped fields, and invalid messages.
#include "fusion/signal_messages.h"

#include <string>

#include "fusion/complete_signal_messages.h"
#include <gtest/gtest.h>

namespace datmo {
namespace {

using samples::refusalOf;
using samples::WireBits;

TEST(Spatem, ItsBitsAreThoseOfTheStandard) {
  EXPECT_EQ(encode(samples::spatem()), samples::wireSpatem().bytes());
  const Spatem message = decodeSpatem(samples::wireSpatem().bytes());
  EXPECT_EQ(message.header.station, 0x00ABCDEF);
  EXPECT_EQ(message.minute, 1234);
  ASSERT_EQ(message.intersections.size(), 1U);
  const SpatIntersection& intersection = message.intersections[0];
  EXPECT_EQ(toText(intersection.id), "12.3456");
  EXPECT_EQ(intersection.revision, 7);
  EXPECT_TRUE(intersection.hasStatus(5));
  EXPECT_FALSE(intersection.hasStatus(9));
  EXPECT_EQ(intersection.minute, 1235);
  EXPECT_EQ(intersection.millisecond, 59250);
  ASSERT_EQ(intersection.movements.size(), 1U);
  EXPECT_EQ(intersection.movements[0].group, 3);
  ASSERT_EQ(intersection.movements[0].events.size(), 2U);
  const SpatEvent& green = intersection.movements[0].events[0];
  EXPECT_EQ(green.state, SignalState::kProtected);
  ASSERT_TRUE(green.timing);
  EXPECT_EQ(green.timing->min_end, 1200);
  EXPECT_EQ(green.timing->max_end, 1300);
  EXPECT_EQ(green.timing->likely, 1250);
  EXPECT_FALSE(green.timing->start);
  EXPECT_FALSE(intersection.movements[0].events[1].timing);
}

TEST(Mapem, ItsBitsAreThoseOfTheStandard) {
  EXPECT_EQ(encode(samples::mapem()), samples::wireMapem().bytes());
  const Mapem message = decodeMapem(samples::wireMapem().bytes());
  ASSERT_EQ(message.intersections.size(), 1U);
  const MapIntersection& intersection = message.intersections[0];
  EXPECT_EQ(toText(intersection.id), "3456");
  EXPECT_EQ(intersection.latitude, 451900000);
  EXPECT_EQ(intersection.longitude, 57200000);
  EXPECT_EQ(intersection.lane_width, 350);
  ASSERT_EQ(intersection.lanes.size(), 2U);
  const MapLane& lane = intersection.lanes[0];
  EXPECT_EQ(lane.direction, MapLane::kIngress);
  ASSERT_EQ(lane.nodes.size(), 3U);
  EXPECT_EQ(lane.nodes[0].y, -200);
  EXPECT_EQ(lane.nodes[2].x, 30000);
  ASSERT_EQ(lane.connections.size(), 2U);
  EXPECT_EQ(lane.connections[0].group, 3);
  EXPECT_EQ(lane.connections[0].maneuvers, 0x800);
  EXPECT_FALSE(lane.connections[1].group);
  ASSERT_TRUE(intersection.lanes[1].computed);
  EXPECT_EQ(intersection.lanes[1].computed->reference, 5);
  EXPECT_EQ(intersection.lanes[1].computed->y, 3500);
}

TEST(Spatem, UnreadFieldsAreSkipped) {
  const WireBits bits = samples::spatemWithAll();
  const std::size_t size = bits.size();
  const Spatem message = decodeSpatem(bits.bytes());
  ASSERT_EQ(message.intersections.size(), 1U);
  EXPECT_EQ(message.intersections[0].id.number, 77);
  ASSERT_EQ(message.intersections[0].movements.size(), 1U);
  EXPECT_EQ(message.intersections[0].movements[0].group, 9);
  EXPECT_EQ(message.intersections[0].movements[0].events[0].state, SignalState::kStop);
  // All of it was parsed: with one octet less it is incomplete.
  EXPECT_EQ(refusalOf([&] { decodeSpatem(bits.bytes().substr(0, (size - 1) / 8)); }),
            "truncated_message");
}

TEST(Mapem, UnreadFieldsAreSkipped) {
  const WireBits bits = samples::mapemWithAll();
  const Mapem message = decodeMapem(bits.bytes());
  ASSERT_EQ(message.intersections.size(), 1U);
  ASSERT_EQ(message.intersections[0].lanes.size(), 1U);
  const MapLane& lane = message.intersections[0].lanes[0];
  EXPECT_EQ(lane.id, 200);
  EXPECT_EQ(lane.type, 2);
  ASSERT_EQ(lane.nodes.size(), 2U);
  EXPECT_TRUE(lane.nodes[0].is_geodetic);
  EXPECT_EQ(lane.nodes[0].y, 451910000);
  EXPECT_EQ(lane.nodes[1].x, 1000);
  EXPECT_EQ(refusalOf([&] { decodeMapem(bits.bytes().substr(0, (bits.size() - 1) / 8)); }),
            "truncated_message");
}

TEST(Mapem, ANodeOfARegionMakesItsLaneOneWithoutNodes) {
  WireBits bits = samples::signalHeader(5)
                      .add(0, 1)
                      .add(0b00010000, 8)
                      .add(9, 7)
                      .add(0, 5)
                      .add(0, 6)
                      .add(0, 1)
                      .add(1, 16)
                      .add(0, 7)
                      .add(0, 3)
                      .add(0, 31)
                      .add(0, 32)
                      .add(0, 8)
                      .add(0, 8)
                      .add(5, 8)
                      .add(0, 1)
                      .add(0b10, 2)
                      .add(0, 10)
                      .add(0b1, 1)  // a type from a later version
                      .add(0, 7)
                      .addOpen(WireBits().add(1, 3))
                      .add(0b00, 2)
                      .add(0, 6)
                      .add(0, 2)
                      .add(7, 3)
                      .add(3, 8)
                      .addOpen(WireBits().add(1, 3))
                      .add(0, 2)
                      .add(0, 3)
                      .add(512, 10)
                      .add(512, 10);
  const Mapem message = decodeMapem(bits.bytes());
  EXPECT_TRUE(message.intersections.at(0).lanes.at(0).nodes.empty());
  EXPECT_EQ(message.intersections[0].lanes[0].type, MapLane::kOtherType);
}

TEST(SignalMessages, OtherKindsAndVersionsAreRefused) {
  EXPECT_EQ(refusalOf([] { decodeSpatem(samples::wireMapem().bytes()); }), "other_message");
  EXPECT_EQ(refusalOf([] { decodeMapem(samples::wireSpatem().bytes()); }), "other_message");
  std::string old = samples::wireSpatem().bytes();
  old[0] = 1;
  EXPECT_EQ(refusalOf([&] { decodeSpatem(old); }), "other_version");
  Spatem bad = samples::spatem();
  bad.intersections[0].movements[0].group = 256;
  EXPECT_EQ(refusalOf([&] { encode(bad); }), "bad_message");
  bad = samples::spatem();
  bad.intersections.clear();
  EXPECT_EQ(refusalOf([&] { encode(bad); }), "bad_message");
}

}  // namespace
}  // namespace datmo
