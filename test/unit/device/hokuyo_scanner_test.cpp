// SPDX-License-Identifier: BSD-3-Clause
// The client of a scanner against a fake one on loopback: its output, and what happens if the
// device misbehaves.
#include "datmo_fusion/device/hokuyo_scanner.h"

#include <cmath>

#include "device/device_probe.h"
#include "device/fake_hokuyo.h"
#include <gtest/gtest.h>

namespace datmo::hokuyo_scanner_test {
namespace {

using samples::DeviceProbe;
using samples::FakeHokuyo;
using samples::Measured;

constexpr double kStart = DeviceProbe::kStart;

class HokuyoScannerTest : public testing::Test {
 protected:
  void start() { probe_.start(fake_.port()); }

  void connect() {
    fake_.accept();
    fake_.shakeHands();
    probe_.devices.take();
  }

  /// Sends a scan that arrives at a time of the computer (s after the start), and returns the
  /// measurement; `clock`: ms of the device.
  Measured exchange(std::uint32_t clock, double host) {
    probe_.host = host;
    fake_.send(FakeHokuyo::scan(clock & 0xFFFFFFU, {1000, 2000, 3000, 4000, 5000}));
    return probe_.measurements.take();
  }

  FakeHokuyo fake_;
  DeviceProbe probe_{DeviceKind::kHokuyo};
};

TEST_F(HokuyoScannerTest, AScanIsDeliveredAsSent) {
  start();
  connect();
  const Measured scan = exchange(100, 5.0);
  EXPECT_EQ(scan.scan().ranges, (std::vector<float>{1.0F, 2.0F, 3.0F, 4.0F, 5.0F}));
  EXPECT_NEAR(secondsBetween(Stamp::fromSeconds(kStart + 5.0), scan.stamp), -FakeHokuyo::kSweep,
              1e-6);
  EXPECT_NEAR(scan.clock.offset, kStart + 4.9, 1e-3);
}

TEST_F(HokuyoScannerTest, SplitPacketsBecomeOneScan) {
  start();
  connect();
  const std::string bytes = FakeHokuyo::scan(100, {1000, 2000, 3000, 4000, 5000});
  for (const char byte : bytes) {
    fake_.send(std::string(1, byte));
  }
  EXPECT_EQ(probe_.measurements.take().scan().ranges.size(), FakeHokuyo::kBeams);
}

TEST_F(HokuyoScannerTest, MissingScansAreCounted) {
  start();
  connect();
  EXPECT_EQ(exchange(100, 0.0).missed, 0U);
  EXPECT_EQ(exchange(125, 0.025).missed, 0U);
  EXPECT_EQ(exchange(225, 0.125).missed, 3U);
}

TEST_F(HokuyoScannerTest, StampsContinueWhenTheDevicesClockWraps) {
  start();
  connect();
  exchange(0xFFFFFF - 9, 0.0);
  const Measured scan = exchange(0xFFFFFF - 9 + 25, 0.025);
  EXPECT_EQ(scan.missed, 0U);
  EXPECT_EQ(scan.clock.steps, 0U);
  EXPECT_NEAR(secondsBetween(Stamp::fromSeconds(kStart), scan.stamp), 0.025 - FakeHokuyo::kSweep,
              1e-6);
}

TEST_F(HokuyoScannerTest, DriftAndStepsOfTheClockAreFollowed) {
  start();
  connect();
  constexpr double kDrift = 1e-4;
  double host = 0.0;
  for (int i = 0; i < 2400; ++i) {  // a minute
    host = i * FakeHokuyo::kScanTime;
    // The device's clock has millisecond resolution; the network is up to 3 ms late.
    const auto clock = static_cast<std::uint32_t>((1.0 - kDrift) * host * 1e3);
    const Measured scan = exchange(clock, host + 1e-3 * (i % 4));
    const double late =
        secondsBetween(Stamp::fromSeconds(kStart + host), scan.stamp) + FakeHokuyo::kSweep;
    if (i > 400) {
      EXPECT_LT(std::abs(late), 2.5e-3);
    }
  }
  const auto clock = static_cast<std::uint32_t>((1.0 - kDrift) * host * 1e3);
  const Measured scan = exchange(clock + 25, host + 0.025);
  EXPECT_NEAR(scan.clock.drift, kDrift, 2e-5);
  EXPECT_EQ(scan.clock.steps, 0U);
  const Measured after = exchange(clock + 1050, host + 0.05);
  EXPECT_EQ(after.clock.steps, 1U);
  EXPECT_EQ(after.missed, 0U);
  EXPECT_NEAR(secondsBetween(scan.stamp, after.stamp), 0.025, 2e-3);
}

TEST_F(HokuyoScannerTest, ADeviceThatReturnsIsConnectedAgain) {
  start();
  connect();
  exchange(100, 0.0);
  fake_.send("MD00060010");  // half of it
  fake_.close();
  EXPECT_EQ(probe_.faults.take(), "lost_connection");
  connect();
  const Measured scan = exchange(7, 2.0);  // it was switched off: its clock restarts
  EXPECT_EQ(scan.missed, 0U);
  EXPECT_NEAR(secondsBetween(Stamp::fromSeconds(kStart), scan.stamp), 2.0 - FakeHokuyo::kSweep,
              1e-6);
}

TEST_F(HokuyoScannerTest, AWrongAnswerIsOneFaultAndAnotherConnection) {
  start();
  connect();
  std::string broken = FakeHokuyo::scan(100, {1000, 2000, 3000, 4000, 5000});
  ++broken[broken.size() - 6];
  fake_.send(broken);
  EXPECT_EQ(probe_.faults.take(), "bad_answer");
  connect();
  EXPECT_EQ(exchange(100, 1.0).scan().ranges.size(), FakeHokuyo::kBeams);
}

TEST_F(HokuyoScannerTest, AnotherDeviceIsRefused) {
  start();
  fake_.accept();
  fake_.shakeHands({"MODL:radio"});
  EXPECT_EQ(probe_.faults.take(), "wrong_device");
  fake_.accept();
  fake_.command();
  fake_.send("HTTP/1.1 400 Bad Request\nServer: x\n\n");
  EXPECT_EQ(probe_.faults.take(), "bad_answer");
}

TEST_F(HokuyoScannerTest, ALaserThatStaysOffIsReported) {
  start();
  fake_.accept();
  for (std::string asked = fake_.command(); asked != "BM"; asked = fake_.command()) {
    fake_.answer(asked, "00", asked == "PP" ? FakeHokuyo::kModel : std::vector<std::string>());
  }
  fake_.answer("BM", "01");
  EXPECT_EQ(probe_.faults.take(), "device_fault");
}

TEST_F(HokuyoScannerTest, ASilentDeviceIsConnectedAgain) {
  probe_.setup.timeout = 0.05;
  start();
  fake_.accept();
  EXPECT_EQ(probe_.faults.take(), "silent_device");
}

}  // namespace
}  // namespace datmo::hokuyo_scanner_test
