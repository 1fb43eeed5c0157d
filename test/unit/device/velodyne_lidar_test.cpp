// SPDX-License-Identifier: BSD-3-Clause
// A Velodyne lidar packet by packet: its turns, and the time of each point.
#include "datmo_fusion/device/velodyne_lidar.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "device/velodyne_lidar_case.h"

#include "datmo_fusion/common/angle.h"

namespace datmo::velodyne_lidar_test {
namespace {

using samples::kDual;
using samples::kHdl32e;
using samples::kVlp32c;
using samples::VelodyneLidarTest;
using samples::VelodyneSample;
using samples::VelodyneStream;

/// A lidar that reports two returns of each firing.
class TwoReturnsTest : public VelodyneLidarTest {
 protected:
  /// Reads two whole turns of a product; `step`: from a firing to the next, hundredths of a degree;
  /// `firings`: of a turn; `name`: that it reports.
  void readTurns(std::uint8_t product, unsigned step, std::size_t firings,
                 const std::string& name) {
    VelodyneSample sample;
    sample.product = product;
    sample.returns = kDual;
    sample.step = step;
    VelodyneStream stream{sample};
    sendTurns(stream, 2.6);
    connect();
    EXPECT_EQ(name_, name);
    turns_ = clouds();
    ASSERT_EQ(turns_.size(), 2U);
    EXPECT_EQ(points(turns_[0]).size(), 2U * firings * VelodyneModel::kChannels);
    EXPECT_EQ(turns_[1].missed, 0U);
  }

  std::vector<DeviceMeasurement> turns_;
};

TEST_F(VelodyneLidarTest, EachTurnIsACloudFromSeamToSeam) {
  VelodyneStream stream{VelodyneSample()};
  sendTurns(stream, 3.0);
  connect();
  EXPECT_EQ(name_, "VLP-16, one return");
  const auto turns = clouds();
  ASSERT_EQ(turns.size(), 2U);  // the first half turn and the last one are not whole
  for (const DeviceMeasurement& turn : turns) {
    EXPECT_EQ(turn.missed, 0U);
    EXPECT_EQ(points(turn).size(), 900U * VelodyneModel::kChannels);
    // It begins behind.
    EXPECT_NEAR(std::abs(std::atan2(points(turn).front().y, points(turn).front().x)), kPi, 0.01);
    EXPECT_FLOAT_EQ(points(turn).front().time, 0.0F);
    EXPECT_NEAR(points(turn).back().time, 900 * 110.592e-6, 1e-4);
  }
  // The stream begins at azimuth 0 and time 0 of the computer: half a turn later. A packet's last
  // firing is 21 us before the next packet.
  EXPECT_NEAR(seconds(turns[0].stamp), 450 * 110.592e-6, 3e-5);
  EXPECT_NEAR(secondsBetween(turns[0].stamp, turns[1].stamp), 900 * 110.592e-6, 2e-6);
}

TEST_F(VelodyneLidarTest, TimesOfAllPointsAreThoseOfTheirAzimuth) {
  VelodyneStream stream{VelodyneSample()};
  sendTurns(stream, 2.5);
  connect();
  const auto turns = clouds();
  ASSERT_FALSE(turns.empty());
  for (const CloudPoint& point : points(turns[0])) {
    // Clockwise from behind.
    const double turned = std::fmod(1.5 * kTurn - std::atan2(point.y, point.x), kTurn) / kTurn;
    ASSERT_NEAR(turned, point.time / (900 * 110.592e-6), 2e-5);
  }
}

TEST_F(VelodyneLidarTest, TheSeamIsAtTheRequestedBearing) {
  options_.seam = kPi / 2.0;  // to the left
  VelodyneStream stream{VelodyneSample()};
  sendTurns(stream, 3.0);
  connect();
  const auto turns = clouds();
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_NEAR(std::atan2(points(turns[0]).front().y, points(turns[0]).front().x), kPi / 2.0, 0.01);
}

TEST_F(TwoReturnsTest, ALidarWithThePacketTimeAtTheEndIsReadWithTwoReturns) {
  ASSERT_NO_FATAL_FAILURE(readTurns(kHdl32e, 16, 2250, "HDL-32E, two returns"));
  // Sent at the last firing, which is 9.2 us before the next packet's first one.
  EXPECT_NEAR(seconds(turns_[0].stamp), 1125 * 46.08e-6, 3e-5);
}

TEST_F(TwoReturnsTest, ALidarWithAzimuthOffsetsIsReadWithTwoReturns) {
  ASSERT_NO_FATAL_FAILURE(readTurns(kVlp32c, 20, 1800, "VLP-32C, two returns"));
  EXPECT_NEAR(secondsBetween(turns_[0].stamp, turns_[1].stamp), 1800 * 55.296e-6, 2e-6);
}

}  // namespace
}  // namespace datmo::velodyne_lidar_test
