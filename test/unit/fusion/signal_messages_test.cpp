// SPDX-License-Identifier: BSD-3-Clause
// SPATEM and MAPEM: bits by hand, there and back, what is passed over, and what is none.
#include "fusion/signal_messages.h"

#include <string>

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

TEST(Spatem, WhatIsNotReadIsPassedOver) {
  const WireBits regional = WireBits().add(0, 2).add(3, 8).addOpen(WireBits().add(0xABC, 12));
  const WireBits assist = WireBits()
                              .add(0, 1)
                              .add(0b11110, 5)  // all but the region
                              .add(4, 8)
                              .add(100, 14)
                              .add(200, 14)
                              .add(1, 1)
                              .add(0, 1);
  const WireBits advice = WireBits()
                              .add(1, 1)  // extended
                              .add(0b11110, 5)
                              .add(0, 1)
                              .add(1, 2)
                              .add(139, 9)
                              .add(4, 3)
                              .add(50, 14)
                              .add(2, 8)
                              .add(0, 1)  // one addition,
                              .add(0, 6)
                              .add(1, 1)  // which is there
                              .addOpen(WireBits().add(0xFF, 8));
  WireBits bits = samples::signalHeader(4)
                      .add(0, 1)
                      .add(0b010, 3)  // a name alone
                      .add(2 - 1, 6)
                      .add('S', 7)
                      .add('1', 7)
                      .add(0, 5)
                      .add(1, 1)         // extended
                      .add(0b100111, 6)  // name, lanes, assist, region
                      .add(0, 6)
                      .add('X', 7)
                      .add(0, 1)
                      .add(77, 16)
                      .add(0, 7)
                      .add(0, 16)
                      .add(1, 4)  // two lanes that are open
                      .add(5, 8)
                      .add(6, 8)
                      .add(0, 8)
                      .add(0, 1)
                      .add(0b111, 3)
                      .add(0, 6)
                      .add('M', 7)
                      .add(9, 8)
                      .add(0, 4)
                      .add(0, 1)
                      .add(0b011, 3)  // speeds and region
                      .add(3, 4)
                      .add(0, 4)
                      .add(advice)
                      .add(regional)
                      .add(0, 4)
                      .add(assist)
                      .add(regional)
                      .add(0, 4)
                      .add(assist)
                      .add(regional)
                      .add(0, 1)  // of the intersection: one addition
                      .add(0, 6)
                      .add(1, 1)
                      .addOpen(WireBits().add(0x12, 8));
  const std::size_t size = bits.size();
  const Spatem message = decodeSpatem(bits.bytes());
  ASSERT_EQ(message.intersections.size(), 1U);
  EXPECT_EQ(message.intersections[0].id.number, 77);
  ASSERT_EQ(message.intersections[0].movements.size(), 1U);
  EXPECT_EQ(message.intersections[0].movements[0].group, 9);
  EXPECT_EQ(message.intersections[0].movements[0].events[0].state, SignalState::kStop);
  // All of it was walked over: with an octet less it is not whole.
  EXPECT_EQ(refusalOf([&] { decodeSpatem(bits.bytes().substr(0, (size - 1) / 8)); }),
            "truncated_message");
}

TEST(Mapem, WhatIsNotReadIsPassedOver) {
  const WireBits regional = WireBits().add(0, 2).add(3, 8).addOpen(WireBits().add(0x5, 4));
  const WireBits limits = WireBits().add(0, 4).add(0, 1).add(5, 4).add(694, 13);
  const WireBits attributes = WireBits()
                                  .add(0, 1)
                                  .add(0b1111111, 7)
                                  .add(0, 3)
                                  .add(0, 1)
                                  .add(1, 4)  // stop line
                                  .add(0, 3)
                                  .add(0, 1)
                                  .add(2, 6)
                                  .add(0, 3)
                                  .add(1, 1)  // a segment's name of a later version
                                  .add(0, 1)
                                  .add(3, 6)
                                  .add(2, 3)  // data: angle, merge angle, speed limits
                                  .add(0, 4)
                                  .add(150, 9)
                                  .add(4, 4)
                                  .add(180, 9)
                                  .add(5, 4)
                                  .add(limits)
                                  .add(512, 10)
                                  .add(512, 10)
                                  .add(regional);
  WireBits bits = samples::signalHeader(5)
                      .add(0, 1)
                      .add(0b11110000, 8)
                      .add(4, 20)
                      .add(1, 7)
                      .add(0, 1)  // layer type
                      .add(3, 3)
                      .add(50, 7)
                      .add(0, 5)
                      .add(0, 1)
                      .add(0b10111, 5)  // name, limits, preemption, region
                      .add(0, 6)
                      .add('N', 7)
                      .add(0, 1)
                      .add(3456, 16)
                      .add(0, 7)
                      .add(0, 1)
                      .add(0b11, 2)  // elevation, region
                      .add(451900000 + 900000000, 31)
                      .add(57200000 + 1800000000, 32)
                      .add(2120 + 4096, 16)
                      .add(regional)
                      .add(limits)
                      .add(0, 8)
                      .add(0, 1)
                      .add(0b1111011, 7)  // all but connections
                      .add(200, 8)
                      .add(0, 6)
                      .add('L', 7)
                      .add(1, 4)
                      .add(2, 4)
                      .add(1, 1)  // attributes with a region
                      .add(0b11, 2)
                      .add(1 << 6, 10)
                      .add(0, 1)
                      .add(2, 3)  // for bicycles
                      .add(0, 16)
                      .add(3, 8)
                      .addOpen(WireBits().add(1, 1))
                      .add(0x800, 12)
                      .add(0b00, 2)
                      .add(0, 6)  // two nodes
                      .add(0b01, 2)
                      .add(6, 3)  // a position on the earth
                      .add(57210000 + 1800000000, 32)
                      .add(451910000 + 900000000, 31)
                      .add(attributes)
                      .add(0b00, 2)
                      .add(4, 3)
                      .add(1000 + 8192, 14)
                      .add(0 + 8192, 14)
                      .add(1, 3)  // two overlays
                      .add(1, 8)
                      .add(2, 8)
                      .add(regional)
                      .add(0, 5)  // preemption
                      .add(0, 1)
                      .add(3, 8)
                      .addOpen(WireBits().add(1, 1))
                      .add(regional);
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
                      .add(0b1, 1)  // a type of a later version
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
