// SPDX-License-Identifier: BSD-3-Clause
// A lidar of Velodyne's packet by packet: turns, lost packets, its clock, and what is no lidar.
#include "datmo_fusion/device/velodyne_lidar.h"

#include <atomic>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "device/velodyne_packets.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::velodyne_lidar_test {
namespace {

using samples::kDual;
using samples::kHdl32e;
using samples::kVlp16;
using samples::VelodyneSample;
using samples::VelodyneStream;

constexpr double kStart = 1.7e9;  // s, when the computer's time is 0

struct SentPacket {
  double arrival = 0.0;  ///< s, of the computer
  std::string bytes;
};

/// Packets of a list; at its end the recording is, too.
class ListedPackets : public PacketSource {
 public:
  ListedPackets(std::deque<SentPacket>& packets, double& now) : packets_(packets), now_(now) {}

  std::string_view next() override {
    if (packets_.empty()) {
      throw RecordingEnd("all sent");
    }
    current_ = std::move(packets_.front());
    packets_.pop_front();
    now_ = current_.arrival;
    return current_.bytes;
  }

 private:
  std::deque<SentPacket>& packets_;
  double& now_;
  SentPacket current_;
};

class VelodyneLidarTest : public testing::Test {
 protected:
  /// Packets of a lidar for so many turns, each up to `jitter` (s) late; `drift`: of its clock,
  /// s/s.
  void sendTurns(VelodyneStream& stream, double turns, double drift = 0.0, double jitter = 0.0) {
    const int count = static_cast<int>(std::lround(turns * stream.packetsPerTurn()));
    for (int i = 0; i < count; ++i) {
      send(stream, drift, jitter * (i % 4) / 3.0);
    }
  }

  void send(VelodyneStream& stream, double drift = 0.0, double late = 0.0) {
    // It arrives when it is done, by the computer's clock since the stream's first second.
    const double done = (stream.time() * 1e-6 + stream.period() - 1.0) / (1.0 - drift) + late;
    packets_.push_back({done, stream.next()});
  }

  void connect() {
    lidar_.emplace([this] { return std::make_unique<ListedPackets>(packets_, now_); }, options_,
                   host_);
    name_ = lidar_->connect();
  }

  /// All clouds until nothing is sent any more.
  std::vector<DeviceMeasurement> clouds() {
    std::vector<DeviceMeasurement> all;
    try {
      while (true) {
        all.push_back(lidar_->next());
      }
    } catch (const RecordingEnd&) {
    }
    return all;
  }

  std::string faultOf() {
    try {
      while (true) {
        lidar_->next();
      }
    } catch (const DeviceError& error) {
      return error.reason();
    }
  }

  static double seconds(Stamp stamp) { return secondsBetween(Stamp::fromSeconds(kStart), stamp); }

  static const std::vector<CloudPoint>& points(const DeviceMeasurement& measurement) {
    return std::get<DeviceCloud>(measurement.data).points;
  }

  double now_ = 0.0;
  std::deque<SentPacket> packets_;
  std::atomic<bool> stop_{false};
  DeviceClock clock_{ClockOptions(), [this] { return Stamp::fromSeconds(kStart + now_); }};
  std::map<std::string, int> warnings_;
  DeviceHost host_{stop_, clock_,
                   [this](const DeviceError& error) { ++warnings_[error.reason()]; }};
  VelodyneOptions options_;
  std::optional<VelodyneLidar> lidar_;
  std::string name_;
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

TEST_F(VelodyneLidarTest, TheSeamIsWhereItIsAskedFor) {
  options_.seam = kPi / 2.0;  // to the left
  VelodyneStream stream{VelodyneSample()};
  sendTurns(stream, 3.0);
  connect();
  const auto turns = clouds();
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_NEAR(std::atan2(points(turns[0]).front().y, points(turns[0]).front().x), kPi / 2.0, 0.01);
}

TEST_F(VelodyneLidarTest, TheLidarsWithTheirPacketsTimeAtTheEndAndTwoReturnsAreRead) {
  VelodyneSample sample;
  sample.product = kHdl32e;
  sample.returns = kDual;
  sample.step = 16;
  VelodyneStream stream{sample};
  sendTurns(stream, 2.6);
  connect();
  EXPECT_EQ(name_, "HDL-32E, two returns");
  const auto turns = clouds();
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_EQ(points(turns[0]).size(), 2U * 2250U * VelodyneModel::kChannels);
  EXPECT_EQ(turns[1].missed, 0U);
  // Sent at the last firing, which is 9.2 us before the next packet's first one.
  EXPECT_NEAR(seconds(turns[0].stamp), 1125 * 46.08e-6, 3e-5);
}

TEST_F(VelodyneLidarTest, PacketsThatAreLostAreCountedAndTheirTurnGoesOn) {
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

TEST_F(VelodyneLidarTest, ATurnWithALongGapIsLeftOut) {
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

TEST_F(VelodyneLidarTest, PacketsThatOvertookEachOtherCostThemselvesAlone) {
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

TEST_F(VelodyneLidarTest, TheHourIsNoStep) {
  VelodyneStream stream{VelodyneSample()};
  stream.setTime(3.6e9 - 150000.0);
  sendTurns(stream, 3.0);
  connect();
  const auto turns = clouds();
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_EQ(clock_.state().steps, 0U);
  EXPECT_NEAR(secondsBetween(turns[0].stamp, turns[1].stamp), 900 * 110.592e-6, 2e-6);
}

TEST_F(VelodyneLidarTest, ADriftingClockAndOneThatIsASecondOffAreFollowed) {
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
  // Its receiver has found the satellites: the lidar's time is another.
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

TEST_F(VelodyneLidarTest, PacketsOfOthersAreCountedAndManyInARowAreAFault) {
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

TEST_F(VelodyneLidarTest, AnotherModelIsRefusedUnlessItIsNamed) {
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
  options_.model = "VLP-16";  // of old firmware
  connect();
  EXPECT_GE(clouds().size(), 1U);
}

TEST_F(VelodyneLidarTest, ALidarThatDoesNotTurnIsSaid) {
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

TEST_F(VelodyneLidarTest, OneThatDoesNotTurnFromItsStartIsSaid) {
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
}  // namespace datmo::velodyne_lidar_test
