// SPDX-License-Identifier: BSD-3-Clause
// A Velodyne lidar whose packets are lost, late or from another device, whose clock is set, or that
// does not turn.
#include "device/velodyne_lidar_case.h"

namespace datmo::velodyne_faults_test {
namespace {

using samples::kHdl32e;
using samples::VelodyneSample;
using samples::VelodyneStream;

using VelodyneFaultTest = samples::VelodyneLidarTest;

TEST_F(VelodyneFaultTest, LostPacketsAreCountedAndTheirTurnContinues) {
  VelodyneStream stream{VelodyneSample()};
  sendTurns(stream, 1.0);
  stream.skip(3);
  sendTurns(stream, 1.0);
  stream.skip(1);
  sendTurns(stream, 1.0);
  connect();
  const auto turns = clouds();
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_EQ(turns[0].missed, 3U);
  EXPECT_EQ(turns[1].missed, 1U);
  EXPECT_EQ(points(turns[0]).size(), (900U - 36U) * VelodyneModel::kChannels);
}

TEST_F(VelodyneFaultTest, ATurnWithALongGapIsLeftOut) {
  VelodyneStream stream{VelodyneSample()};
  sendTurns(stream, 2.0);
  stream.skip(3 * stream.packetsPerTurn());
  sendTurns(stream, 2.0);
  connect();
  const auto turns = clouds();
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_EQ(turns[1].missed, 225U);
  EXPECT_EQ(points(turns[1]).size(), 900U * VelodyneModel::kChannels);
}

TEST_F(VelodyneFaultTest, ReorderedPacketsCostOnlyThemselves) {
  VelodyneStream stream{VelodyneSample()};
  sendTurns(stream, 3.0);
  std::swap(packets_[100].bytes, packets_[101].bytes);
  packets_.insert(packets_.begin() + 120, packets_[119]);  // twice
  connect();
  const auto turns = clouds();
  EXPECT_EQ(turns.size(), 2U);
  EXPECT_EQ(warnings_["late_packet"], 2);
  EXPECT_EQ(clock_.state().steps, 0U);
}

TEST_F(VelodyneFaultTest, TheHourIsNoStep) {
  VelodyneStream stream{VelodyneSample()};
  stream.setTime(3.6e9 - 150000.0);
  sendTurns(stream, 3.0);
  connect();
  const auto turns = clouds();
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_EQ(clock_.state().steps, 0U);
  EXPECT_NEAR(secondsBetween(turns[0].stamp, turns[1].stamp), 900 * 110.592e-6, 2e-6);
}

TEST_F(VelodyneFaultTest, DriftAndAStepOfTheClockAreFollowed) {
  constexpr double kDrift = 1e-4;
  VelodyneSample sample;
  sample.distances = {0};
  sample.distances.resize(VelodyneModel::kChannels);
  sample.distances[0] = 5000;
  VelodyneStream stream{sample};
  sendTurns(stream, 300.0, kDrift, 3e-3);  // half a minute
  connect();
  std::vector<DeviceMeasurement> turns = clouds();
  EXPECT_NEAR(clock_.state().drift, kDrift, 1e-5);
  EXPECT_EQ(clock_.state().steps, 0U);
  const double turn = 900 * 110.592e-6;
  for (std::size_t i = 150; i < turns.size(); ++i) {
    const double due = (static_cast<double>(i) + 0.5) * turn / (1.0 - kDrift);
    ASSERT_NEAR(seconds(turns[i].stamp), due, 1e-4);
  }
  // Its receiver has found the satellites: the lidar's time jumps.
  const double arrival = packets_.empty() ? now_ : 0.0;
  stream.setTime(stream.time() + 1e6);
  for (int i = 0; i < 3 * stream.packetsPerTurn(); ++i) {
    packets_.push_back({arrival + (i + 1) * stream.period(), stream.next()});
  }
  turns = clouds();
  EXPECT_EQ(clock_.state().steps, 1U);
  ASSERT_GE(turns.size(), 1U);
  EXPECT_LT(seconds(turns.back().stamp), now_);
  EXPECT_GT(seconds(turns.back().stamp), now_ - 2.5 * turn);
  EXPECT_EQ(turns.back().missed, 0U);
}

TEST_F(VelodyneFaultTest, PacketsOfOthersAreCountedAndManyInARowAreAFault) {
  VelodyneStream stream{VelodyneSample()};
  sendTurns(stream, 1.0);
  packets_.push_back({now_, "half"});
  VelodyneSample other;
  other.product = kHdl32e;
  packets_.push_back({now_, other.bytes()});
  sendTurns(stream, 1.0);
  connect();
  EXPECT_EQ(clouds().size(), 1U);
  EXPECT_EQ(warnings_["bad_packet"], 1);
  EXPECT_EQ(warnings_["wrong_device"], 1);
  for (int i = 0; i < 200; ++i) {
    packets_.push_back({now_, std::string(512, 'x')});
  }
  EXPECT_EQ(faultOf(), "bad_packet");
}

TEST_F(VelodyneFaultTest, AnotherModelIsRefusedUnlessItIsNamed) {
  VelodyneSample sample;
  sample.product = 0x63;  // VLS-128
  VelodyneStream stream{sample};
  sendTurns(stream, 3.0);
  try {
    connect();
    FAIL() << "expected a refusal";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.reason(), "wrong_device");
  }
  options_.model = "VLP-16";  // with old firmware
  connect();
  EXPECT_GE(clouds().size(), 1U);
}

TEST_F(VelodyneFaultTest, ANamedModelIsCheckedAgainstThePackets) {
  options_.model = "HDL-32E";
  VelodyneStream stream{VelodyneSample()};
  sendTurns(stream, 1.0);
  try {
    connect();
    FAIL() << "expected a refusal";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.reason(), "wrong_device");
  }
}

TEST_F(VelodyneFaultTest, ALidarThatDoesNotTurnIsReported) {
  VelodyneSample sample;
  VelodyneStream stream{sample};
  sendTurns(stream, 1.0);
  connect();
  clouds();
  sample.step = 0;
  VelodyneStream still{sample};
  still.setTime(stream.time());
  for (int i = 0; i < 1000; ++i) {
    send(still);
  }
  EXPECT_EQ(faultOf(), "device_fault");
}

TEST_F(VelodyneFaultTest, OneThatDoesNotTurnFromItsStartIsReported) {
  VelodyneSample sample;
  sample.step = 0;
  VelodyneStream still{sample};
  for (int i = 0; i < 1000; ++i) {
    send(still);
  }
  connect();
  EXPECT_EQ(faultOf(), "device_fault");
}

}  // namespace
}  // namespace datmo::velodyne_faults_test
