// SPDX-License-Identifier: BSD-3-Clause
// The client of a scanner against a fake one on the loopback: what comes through, and what happens
// when the device does not do as it should.
#include "datmo_fusion/device/hokuyo_scanner.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <stdexcept>

#include "device/fake_scanner.h"
#include <gtest/gtest.h>

namespace datmo::hokuyo_scanner_test {
namespace {

using samples::FakeScanner;

constexpr double kStart = 1.7e9;  // s

/// Waits for what the scanner's thread says.
template <typename Item>
class Mailbox {
 public:
  void put(Item item) {
    const std::lock_guard<std::mutex> lock(mutex_);
    items_.push_back(std::move(item));
    came_.notify_all();
  }

  Item take() {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!came_.wait_for(lock, std::chrono::minutes(1), [this] { return !items_.empty(); })) {
      throw std::runtime_error("nothing came");
    }
    Item item = std::move(items_.front());
    items_.pop_front();
    return item;
  }

 private:
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<Item> items_;
};

class HokuyoScannerTest : public testing::Test {
 protected:
  HokuyoScannerTest() {
    options_.address = "127.0.0.1";
    options_.port = fake_.port();
    options_.timeout = 60.0;  // a busy machine's fake is not silent
    options_.min_backoff = 0.001;
    options_.max_backoff = 0.01;
  }

  void start() {
    DeviceHandlers handlers;
    handlers.connected = [this](const ScipModel& model) { models_.put(model); };
    handlers.scan = [this](const ScipModel&, DeviceScan scan) { scans_.put(std::move(scan)); };
    handlers.fault = [this](const DeviceError& error) { faults_.put(error.reason()); };
    handlers.now = [this] { return Stamp::fromSeconds(kStart + host_.load()); };
    scanner_ = std::make_unique<HokuyoScanner>(options_, handlers);
  }

  void connect() {
    fake_.accept();
    fake_.shakeHands();
    models_.take();
  }

  /// A scan that arrives at a time of the computer (s after the start); `clock`: ms of the device.
  DeviceScan exchange(std::uint32_t clock, double host) {
    host_ = host;
    fake_.send(FakeScanner::scan(clock & 0xFFFFFFU, {1000, 2000, 3000, 4000, 5000}));
    return scans_.take();
  }

  FakeScanner fake_;
  HokuyoOptions options_;
  std::atomic<double> host_{0.0};
  Mailbox<ScipModel> models_;
  Mailbox<DeviceScan> scans_;
  Mailbox<std::string> faults_;
  std::unique_ptr<HokuyoScanner> scanner_;
};

TEST_F(HokuyoScannerTest, AScanComesAsItWasSent) {
  start();
  connect();
  const DeviceScan scan = exchange(100, 5.0);
  EXPECT_EQ(scan.ranges, (std::vector<float>{1.0F, 2.0F, 3.0F, 4.0F, 5.0F}));
  EXPECT_NEAR(secondsBetween(Stamp::fromSeconds(kStart + 5.0), scan.stamp), -FakeScanner::kSweep,
              1e-6);
  EXPECT_NEAR(scan.clock_offset, kStart + 4.9, 1e-3);
}

TEST_F(HokuyoScannerTest, HalfPacketsBecomeOneScan) {
  start();
  connect();
  const std::string bytes = FakeScanner::scan(100, {1000, 2000, 3000, 4000, 5000});
  for (const char byte : bytes) {
    fake_.send(std::string(1, byte));
  }
  EXPECT_EQ(scans_.take().ranges.size(), FakeScanner::kBeams);
}

TEST_F(HokuyoScannerTest, ScansThatAreMissingAreCounted) {
  start();
  connect();
  EXPECT_EQ(exchange(100, 0.0).missed, 0U);
  EXPECT_EQ(exchange(125, 0.025).missed, 0U);
  EXPECT_EQ(exchange(225, 0.125).missed, 3U);
}

TEST_F(HokuyoScannerTest, StampsGoOnWhereTheDevicesClockBeginsAgain) {
  start();
  connect();
  exchange(0xFFFFFF - 9, 0.0);
  const DeviceScan scan = exchange(0xFFFFFF - 9 + 25, 0.025);
  EXPECT_EQ(scan.missed, 0U);
  EXPECT_EQ(scan.clock_steps, 0U);
  EXPECT_NEAR(secondsBetween(Stamp::fromSeconds(kStart), scan.stamp), 0.025 - FakeScanner::kSweep,
              1e-6);
}

TEST_F(HokuyoScannerTest, ADriftingClockAndOneThatIsSetAreFollowed) {
  start();
  connect();
  constexpr double kDrift = 1e-4;
  double host = 0.0;
  for (int i = 0; i < 2400; ++i) {  // a minute
    host = i * FakeScanner::kScanTime;
    // The device's clock has whole milliseconds; the network is up to 3 ms late.
    const auto clock = static_cast<std::uint32_t>((1.0 - kDrift) * host * 1e3);
    const DeviceScan scan = exchange(clock, host + 1e-3 * (i % 4));
    const double late =
        secondsBetween(Stamp::fromSeconds(kStart + host), scan.stamp) + FakeScanner::kSweep;
    if (i > 400) {
      EXPECT_LT(std::abs(late), 2.5e-3);
    }
  }
  const auto clock = static_cast<std::uint32_t>((1.0 - kDrift) * host * 1e3);
  const DeviceScan scan = exchange(clock + 25, host + 0.025);
  EXPECT_NEAR(scan.clock_drift, kDrift, 2e-5);
  EXPECT_EQ(scan.clock_steps, 0U);
  const DeviceScan after = exchange(clock + 1050, host + 0.05);
  EXPECT_EQ(after.clock_steps, 1U);
  EXPECT_EQ(after.missed, 0U);
  EXPECT_NEAR(secondsBetween(scan.stamp, after.stamp), 0.025, 2e-3);
}

TEST_F(HokuyoScannerTest, ADeviceThatIsGoneAndBackIsConnectedAgain) {
  start();
  connect();
  exchange(100, 0.0);
  fake_.send("MD00060010");  // half of it
  fake_.close();
  EXPECT_EQ(faults_.take(), "lost_connection");
  connect();
  const DeviceScan scan = exchange(7, 2.0);  // it was switched off: its clock begins again
  EXPECT_EQ(scan.missed, 0U);
  EXPECT_NEAR(secondsBetween(Stamp::fromSeconds(kStart), scan.stamp), 2.0 - FakeScanner::kSweep,
              1e-6);
}

TEST_F(HokuyoScannerTest, AWrongAnswerIsOneFaultAndAnotherConnection) {
  start();
  connect();
  std::string broken = FakeScanner::scan(100, {1000, 2000, 3000, 4000, 5000});
  ++broken[broken.size() - 6];
  fake_.send(broken);
  EXPECT_EQ(faults_.take(), "bad_answer");
  connect();
  EXPECT_EQ(exchange(100, 1.0).ranges.size(), FakeScanner::kBeams);
}

TEST_F(HokuyoScannerTest, AnotherDeviceIsRefused) {
  start();
  fake_.accept();
  fake_.shakeHands({"MODL:radio"});
  EXPECT_EQ(faults_.take(), "wrong_device");
  fake_.accept();
  fake_.command();
  fake_.send("HTTP/1.1 400 Bad Request\nServer: x\n\n");
  EXPECT_EQ(faults_.take(), "bad_answer");
}

TEST_F(HokuyoScannerTest, ALaserThatStaysOffIsSaid) {
  start();
  fake_.accept();
  for (std::string asked = fake_.command(); asked != "BM"; asked = fake_.command()) {
    fake_.answer(asked, "00", asked == "PP" ? FakeScanner::kModel : std::vector<std::string>());
  }
  fake_.answer("BM", "01");
  EXPECT_EQ(faults_.take(), "device_fault");
}

TEST_F(HokuyoScannerTest, ASilentDeviceIsConnectedAgain) {
  options_.timeout = 0.05;
  start();
  fake_.accept();
  EXPECT_EQ(faults_.take(), "silent_device");
}

TEST_F(HokuyoScannerTest, WhereNobodyListensIsSaid) {
  options_.port = FakeScanner().port();  // closed again
  start();
  EXPECT_EQ(faults_.take(), "no_connection");
}

TEST_F(HokuyoScannerTest, OptionsOutOfRangeAreRefused) {
  options_.port = 0;
  EXPECT_THROW(HokuyoScanner(options_, DeviceHandlers()), OptionError);
}

}  // namespace
}  // namespace datmo::hokuyo_scanner_test
