// SPDX-License-Identifier: BSD-3-Clause
// StationTracks between messages and datagrams: what passes, and what is counted.
#include "datmo_fusion/ros/station_wire.h"

#include "../fusion/wire_messages.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {
namespace {

const Stamp kNoon = Stamp::fromSeconds(1772366400.0);

class StationWireTest : public testing::Test {
 protected:
  static StationTracksMessage ownAt(double seconds) {
    StationTrackList list;
    list.stamp = kNoon + seconds;
    list.station = 5;
    StationTrack own;
    own.velocity = {10.0, 0.0};
    own.heading_variance = 1e-4;
    own.covariance *= 0.04;
    own.length = 4.0;
    own.width = 1.7;
    list.tracks.push_back(own);
    return toMessage(list, LocalPlane({degrees(45.19), degrees(5.72), 0.0}));
  }

  StageMonitor monitor_{"v2x_wire"};
  StationWire wire_{StationWireOptions(), monitor_};
};

TEST_F(StationWireTest, ADatagramIsAListOfTracksOnTheEarth) {
  const StationTracksMessagePtr cpm = wire_.received(samples::wireCpm().bytes(), kNoon);
  ASSERT_TRUE(cpm);
  EXPECT_EQ(toStamp(cpm->header.stamp), kNoon);
  EXPECT_EQ(cpm->station, 77U);
  EXPECT_EQ(cpm->part, 1U);
  EXPECT_EQ(cpm->clock_sigma, 0.0);
  ASSERT_EQ(cpm->tracks.size(), 1U);
  EXPECT_EQ(cpm->tracks[0].id, 42U);
  // 12.22 m east at 45.19 deg: 78,607 m a degree; 5.67 m south: 111,136 m a degree.
  EXPECT_NEAR(cpm->tracks[0].longitude, 5.72 + 12.22 / 78607.0, 1e-7);
  EXPECT_NEAR(cpm->tracks[0].latitude, 45.19 - 5.67 / 111136.0, 1e-7);
  EXPECT_NEAR(cpm->tracks[0].velocity_east, -1.2, 1e-9);
}

TEST_F(StationWireTest, UnusableMessagesAreCountedByReason) {
  EXPECT_FALSE(wire_.received("", kNoon));
  EXPECT_FALSE(wire_.received(samples::wireCam().bytes().substr(0, 20), kNoon));
  EXPECT_EQ(samples::drops(monitor_, "truncated_message"), 2U);
  EXPECT_FALSE(wire_.received(samples::wireCamHead(0, 15).add(0b0100, 4).bytes(), kNoon));
  EXPECT_EQ(samples::drops(monitor_, "no_track"), 1U);
  std::string spatem = samples::wireCam().bytes();
  spatem[1] = 4;
  EXPECT_FALSE(wire_.received(spatem, kNoon));
  EXPECT_EQ(monitor_.droppedCount(), 3U);  // as before: others may send other messages
  EXPECT_EQ(monitor_.figures().at("messages of other kinds"), 1.0);
}

TEST_F(StationWireTest, TimesOutsideTheRangeOfRosAreCounted) {
  // A CAM's time is sent modulo 65.536 s: if a clock starts at 0, half of the values are before it.
  for (int high_byte = 0; high_byte < 256; high_byte += 16) {
    std::string cam = samples::wireCam().bytes();
    cam[6] = static_cast<char>(high_byte);  // of the generation time, after a header of 48 bits
    EXPECT_NO_THROW(wire_.received(cam, Stamp()));
  }
  EXPECT_EQ(samples::drops(monitor_, "stamp_out_of_range"), 8U);
}

TEST_F(StationWireTest, OursAreSentAtMostAtTheirRate) {
  std::size_t sent = 0;
  for (int step = 0; step <= 16; ++step) {
    sent += wire_.toSend(ownAt(0.0625 * step)).size();
  }
  EXPECT_EQ(sent, 2U * 9U);                           // a CAM and a CPM, each 0.125 s
  EXPECT_EQ(wire_.toSend(ownAt(-100.0)).size(), 2U);  // a clock that was set
}

TEST_F(StationWireTest, TheLowFrequencyContainerIsSentTwiceASecond) {
  std::vector<bool> has_low;
  for (int step = 0; step <= 10; ++step) {
    const std::string cam = wire_.toSend(ownAt(0.1 * step)).at(0);
    has_low.push_back((static_cast<unsigned char>(cam[8]) & 0x40U) != 0U);
  }
  EXPECT_EQ(has_low, (std::vector<bool>{true, false, false, false, false, true, false, false, false,
                                        false, true}));
}

TEST_F(StationWireTest, OurOwnMessagesAreIgnored) {
  const std::vector<std::string> sent = wire_.toSend(ownAt(0.0));
  ASSERT_EQ(sent.size(), 2U);
  StageMonitor others_monitor{"other"};
  StationWire other{StationWireOptions(), others_monitor};
  EXPECT_TRUE(other.received(sent[0], kNoon));
  EXPECT_FALSE(wire_.received(sent[0], kNoon));
  EXPECT_EQ(monitor_.figures().at("own messages received back"), 1.0);
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

TEST_F(StationWireTest, AnotherStationWithOurNumberIsNamed) {
  StageMonitor others_monitor{"other"};
  StationWire other{StationWireOptions(), others_monitor};
  const std::vector<std::string> sent = other.toSend(ownAt(0.1));
  ASSERT_FALSE(wire_.toSend(ownAt(0.0)).empty());
  EXPECT_FALSE(wire_.received(sent.at(0), kNoon));
  EXPECT_EQ(samples::drops(monitor_, "own_number"), 1U);
}

TEST_F(StationWireTest, JitterLosesNoListAndFasterOnesAreThinned) {
  std::size_t sent = 0;
  for (int step = 0; step < 100; ++step) {
    sent += wire_.toSend(ownAt(0.1 * step + (step % 2 == 0 ? 0.008 : -0.008))).size();
  }
  EXPECT_EQ(sent, 2U * 100U);
  for (int step = 0; step < 300; ++step) {  // three times as fast
    sent += wire_.toSend(ownAt(10.0 + step / 30.0)).size();
  }
  EXPECT_NEAR(static_cast<double>(sent), 2.0 * 200.0, 2.0);
}

TEST_F(StationWireTest, WithoutOurOwnPositionNothingIsSent) {
  StationTracksMessage message = ownAt(0.0);
  message.tracks[0].id = 3;
  EXPECT_TRUE(wire_.toSend(message).empty());
  message = ownAt(1.0);
  message.tracks[0].latitude = 91.0;
  EXPECT_TRUE(wire_.toSend(message).empty());
  EXPECT_EQ(samples::drops(monitor_, "no_own_position"), 2U);
}

}  // namespace
}  // namespace datmo
