// SPDX-License-Identifier: BSD-3-Clause
// Our own tracks as CAM and CPM, and how others receive them.
#include <cmath>
#include <string>
#include <vector>

#include "fusion/wire_messages.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/fusion/wire/station_messages.h"
#include "datmo_fusion/fusion/wire/wire_error.h"

namespace datmo {
namespace {

const StationMessageOptions kMessageOptions;

/// Ourselves at 10 m/s to the north-west, and others.
StationTrackList ownList(int others) {
  StationTrackList list;
  list.stamp = samples::kWireNoon;
  list.station = 5;
  StationTrack own;
  own.heading = degrees(135.0);
  own.heading_variance = 1e-4;
  own.velocity = 10.0 * Point2(std::cos(own.heading), std::sin(own.heading));
  own.covariance.diagonal() << 0.25, 0.04, 0.04, 0.04;
  own.length = 4.0;
  own.width = 1.7;
  own.class_probabilities[static_cast<std::size_t>(ObjectClass::kVehicle)] = 1.0;
  list.tracks.push_back(own);
  for (int i = 1; i <= others; ++i) {
    StationTrack other;
    other.id = static_cast<std::uint32_t>(i);
    other.position = {20.0 + i, -30.0};
    other.velocity = {-1.5, 0.25};
    other.covariance.diagonal() << 0.04, 0.09, 0.01, 0.02;
    other.heading = degrees(170.0);
    other.heading_variance = 0.01;
    other.length = 1.8;
    other.width = 0.6;
    other.height = 1.7;
    other.class_probabilities[static_cast<std::size_t>(ObjectClass::kCyclist)] = 0.9;
    other.class_probabilities[static_cast<std::size_t>(ObjectClass::kPedestrian)] = 0.1;
    other.existence_probability = 0.95;
    list.tracks.push_back(other);
  }
  return list;
}

const LocalPlane kHere({degrees(45.19), degrees(5.72), 0.0});

/// Transforms a point from a message's plane to ours.
Point2 inOurs(const StationMessage& message, const Point2& point) {
  return kHere.toPlane(message.plane.toGeodetic(point));
}

TEST(OwnStation, IsUnchangedByARoundTrip) {
  const StationTrackList list = ownList(1);
  const std::vector<std::string> bytes = encodeStation(list, kHere, kMessageOptions, true);
  ASSERT_EQ(bytes.size(), 2U);
  const StationMessage cam = decodeStation(bytes[0], samples::kWireNoon, kMessageOptions);
  EXPECT_EQ(cam.list.station, 5U);
  EXPECT_EQ(cam.list.stamp, samples::kWireNoon);
  const StationTrack& self = cam.list.tracks.at(0);
  EXPECT_LT((inOurs(cam, self.position) - list.tracks[0].position).norm(), 0.03);
  EXPECT_LT((self.velocity - list.tracks[0].velocity).norm(), 0.03);
  EXPECT_NEAR(self.heading, degrees(135.0), degrees(0.05));
  EXPECT_NEAR(self.length, 4.0, 1e-6);
  // Rounded up, and with the half length by the heading.
  EXPECT_NEAR(self.covariance(0, 0), 0.25, 0.01);
  EXPECT_NEAR(self.covariance(1, 1), 0.04, 0.005);

  const StationMessage cpm = decodeStation(bytes[1], samples::kWireNoon, kMessageOptions);
  EXPECT_EQ(cpm.list.stamp, samples::kWireNoon);
  ASSERT_EQ(cpm.list.tracks.size(), 1U);
  const StationTrack& sent = list.tracks[1];
  const StationTrack& received = cpm.list.tracks[0];
  EXPECT_EQ(received.id, sent.id);
  EXPECT_LT((inOurs(cpm, received.position) - sent.position).norm(), 0.02);
  EXPECT_LT((received.velocity - sent.velocity).norm(), 0.01);
  EXPECT_NEAR(received.covariance(0, 0), 0.25 + 0.04, 0.01);  // with our own position's
  EXPECT_NEAR(received.covariance(3, 3), 0.02, 0.002);
  EXPECT_NEAR(received.heading, sent.heading, degrees(0.05));
  EXPECT_NEAR(received.height, 1.7, 1e-6);
  EXPECT_NEAR(received.existence_probability, 0.95, 0.04);
  EXPECT_NEAR(received.class_probabilities[static_cast<std::size_t>(ObjectClass::kCyclist)], 0.9,
              1e-6);
}

TEST(OwnStation, ManyTracksAreSentInSegmentsThatFitADatagram) {
  constexpr std::size_t kDatagram = 1400;
  const std::vector<std::string> bytes = encodeStation(ownList(80), kHere, kMessageOptions, false);
  ASSERT_EQ(bytes.size(), 4U);
  std::size_t received = 0;
  for (std::size_t i = 1; i < bytes.size(); ++i) {
    EXPECT_LT(bytes[i].size(), kDatagram);
    const StationMessage message = decodeStation(bytes[i], samples::kWireNoon, kMessageOptions);
    EXPECT_EQ(message.list.part, i);
    received += message.list.tracks.size();
  }
  EXPECT_EQ(received, 80U);
}

TEST(OwnStation, LeavesOutUnencodableTracks) {
  StationTrackList list = ownList(3);
  list.tracks[1].position.x() = 2000.0;
  list.tracks[2].velocity.x() = std::nan("");
  const std::vector<std::string> bytes = encodeStation(list, kHere, kMessageOptions, false);
  const StationMessage message = decodeStation(bytes.at(1), samples::kWireNoon, kMessageOptions);
  ASSERT_EQ(message.list.tracks.size(), 1U);
  EXPECT_EQ(message.list.tracks[0].id, 3U);
}

TEST(OwnStation, WithoutOurselvesSendsNothing) {
  StationTrackList list = ownList(2);
  list.tracks.erase(list.tracks.begin());
  EXPECT_THROW(encodeStation(list, kHere, kMessageOptions, false), WireError);
}

TEST(OwnStation, EncodesExtremesWithinTheirRanges) {
  StationTrackList list = ownList(1);
  for (StationTrack& track : list.tracks) {
    track.covariance *= 1e8;
    track.velocity *= 1e3;
    track.length = 1e3;
    track.heading = -7.0;
  }
  list.tracks[1].id = 70000;
  const std::vector<std::string> bytes = encodeStation(list, kHere, kMessageOptions, true);
  EXPECT_THROW(decodeStation(bytes.at(0), samples::kWireNoon, kMessageOptions),
               WireError);  // it is not known to 41 m
  EXPECT_EQ(decodeCpm(bytes.at(1), ItsDictionary::k221).objects.at(0).id, 69999 - 65536);
}

}  // namespace
}  // namespace datmo
