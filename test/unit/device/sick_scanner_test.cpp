// SPDX-License-Identifier: BSD-3-Clause
// The client of a scanner of SICK's against a fake one on the loopback.
#include "datmo_fusion/device/sick_scanner.h"

#include <cmath>

#include "device/device_probe.h"
#include "device/fake_sick.h"
#include <gtest/gtest.h>

namespace datmo::sick_scanner_test {
namespace {

using samples::DeviceProbe;
using samples::FakeSick;
using samples::Measured;
using samples::SickTelegram;

class SickScannerTest : public testing::Test {
 protected:
  void connect() {
    fake_.accept();
    fake_.shakeHands();
    probe_.devices.take();
  }

  void start() {
    probe_.start(fake_.port());
    connect();
  }

  /// A scan that was sent at a time of the scanner's (us), and arrives at one of the computer's (s
  /// after the start).
  Measured exchange(std::uint16_t counter, std::uint32_t sent, double host) {
    probe_.host = host;
    SickTelegram telegram;
    telegram.counter = counter;
    telegram.sent = sent;
    telegram.begun = sent - 20000;
    fake_.scan(telegram);
    return probe_.measurements.take();
  }

  static double seconds(Stamp stamp) {
    return secondsBetween(Stamp::fromSeconds(DeviceProbe::kStart), stamp);
  }

  FakeSick fake_;
  DeviceProbe probe_{DeviceKind::kSickLms};
};

TEST_F(SickScannerTest, AScanComesAsItWasSent) {
  start();
  const Measured scan = exchange(1, 1020000, 5.0);
  EXPECT_EQ(scan.scan().ranges.size(), 4U);
  EXPECT_EQ(scan.missed, 0U);
  EXPECT_NEAR(seconds(scan.stamp), 5.0 - 0.02, 1e-6);
}

TEST_F(SickScannerTest, HalfPacketsBecomeOneScan) {
  start();
  for (const char byte : colaTelegram(SickTelegram().text())) {
    fake_.send(std::string(1, byte));
  }
  EXPECT_EQ(probe_.measurements.take().scan().ranges.size(), 4U);
}

TEST_F(SickScannerTest, ScansThatAreMissingAreCountedAcrossTheCountersEnd) {
  start();
  EXPECT_EQ(exchange(0xFFFE, 1000000, 0.0).missed, 0U);
  EXPECT_EQ(exchange(0xFFFF, 1040000, 0.04).missed, 0U);
  EXPECT_EQ(exchange(2, 1160000, 0.16).missed, 2U);
}

TEST_F(SickScannerTest, StampsGoOnWhereTheScannersClockBeginsAgain) {
  start();
  exchange(1, 0xFFFFFFFFU - 9999, 0.0);
  const Measured scan = exchange(2, 30000, 0.04);
  EXPECT_EQ(scan.clock.steps, 0U);
  EXPECT_NEAR(seconds(scan.stamp), 0.02, 1e-6);
}

TEST_F(SickScannerTest, ADriftingClockAndOneThatIsASecondOffAreFollowed) {
  start();
  constexpr double kDrift = 1e-4;
  std::uint16_t counter = 0;
  double host = 0.0;
  std::uint32_t sent = 0;
  Measured scan;
  for (int i = 0; i < 1500; ++i) {  // a minute
    host = i * FakeSick::kScanTime;
    sent = 1000000 + static_cast<std::uint32_t>((1.0 - kDrift) * host * 1e6);
    scan = exchange(++counter, sent, host + 1e-3 * (i % 4));  // the network is up to 3 ms late
    if (i > 300) {
      EXPECT_LT(std::abs(seconds(scan.stamp) + 0.02 - host), 1e-3);
    }
  }
  EXPECT_NEAR(scan.clock.drift, kDrift, 1e-5);
  EXPECT_EQ(scan.clock.steps, 0U);
  scan = exchange(++counter, sent + 1040000, host + 0.04);
  EXPECT_EQ(scan.clock.steps, 1U);
  EXPECT_EQ(scan.missed, 0U);
  EXPECT_NEAR(seconds(scan.stamp), host + 0.04 - 0.02, 1e-3);
}

TEST_F(SickScannerTest, AScannerThatIsGoneAndBackIsConnectedAgain) {
  start();
  exchange(100, 5000000, 0.0);
  fake_.send("\x02sSN LMDscan");
  fake_.close();
  EXPECT_EQ(probe_.faults.take(), "lost_connection");
  connect();
  const Measured scan = exchange(3, 40000, 2.0);  // it was switched off: its clock begins again
  EXPECT_EQ(scan.missed, 0U);
  EXPECT_NEAR(seconds(scan.stamp), 2.0 - 0.02, 1e-6);
}

TEST_F(SickScannerTest, AWrongScanIsOneFaultAndAnotherConnection) {
  start();
  fake_.answer("sSN LMDscandata 1 1 A037B9 0 0");
  EXPECT_EQ(probe_.faults.take(), "bad_answer");
  connect();
  fake_.answer("sFA 7");
  EXPECT_EQ(probe_.faults.take(), "device_fault");
  connect();
  EXPECT_EQ(exchange(1, 1000000, 0.0).scan().ranges.size(), 4U);
}

TEST_F(SickScannerTest, ScansOfAnOldConnectionArePassedOver) {
  probe_.start(fake_.port());
  fake_.accept();
  fake_.command();
  fake_.scan(SickTelegram());
  fake_.answer(FakeSick::goodAnswer("sRN DeviceIdent", "LMS111"));
  fake_.shakeHands();
  EXPECT_EQ(probe_.devices.take(), "LMS111 at 127.0.0.1");
}

TEST_F(SickScannerTest, AnotherModelIsRefused) {
  probe_.start(fake_.port());
  fake_.accept();
  fake_.shakeHands("NAV310");
  EXPECT_EQ(probe_.faults.take(), "wrong_device");
}

TEST_F(SickScannerTest, AnErrorInPlaceOfAnAnswerIsReported) {
  probe_.start(fake_.port());
  fake_.accept();
  fake_.command();
  fake_.answer("sFA 3");
  EXPECT_EQ(probe_.faults.take(), "device_fault");
}

TEST_F(SickScannerTest, APasswordThatWasChangedIsReported) {
  probe_.start(fake_.port());
  fake_.accept();
  fake_.answer(FakeSick::goodAnswer(fake_.command(), "LMS111"));
  fake_.command();
  fake_.answer("sAN SetAccessMode 0");
  EXPECT_EQ(probe_.faults.take(), "device_fault");
}

TEST_F(SickScannerTest, SilenceIsNoFaultWhileItWarmsUp) {
  probe_.setup.timeout = 0.5;
  start();
  EXPECT_EQ(fake_.command(), "sRN STlms");
  fake_.send(colaTelegram("sRA STlms 5 0 8 00:00:14 8 01.01.00 0 0 0") +
             colaTelegram(SickTelegram().text()));
  EXPECT_EQ(probe_.warnings.take(), "warming_up");
  EXPECT_EQ(probe_.measurements.take().scan().ranges.size(), 4U);
  EXPECT_EQ(fake_.command(), "sRN STlms");
  fake_.answer("sRA STlms 7 0 8 00:00:15 8 01.01.00 0 0 0");
  EXPECT_EQ(probe_.faults.take(), "silent_device");
}

TEST_F(SickScannerTest, SilenceFromTheStartNamesTheDialect) {
  const std::atomic<bool> stop{false};
  DeviceClock clock(ClockOptions(), [] { return Stamp(); });
  SickScanner scanner({"127.0.0.1", fake_.port(), 0.05}, {stop, clock, {}});
  try {
    scanner.connect();
    FAIL() << "expected a fault";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.reason(), "silent_device");
    EXPECT_NE(std::string(error.what()).find("CoLa A"), std::string::npos) << error.what();
  }
}

TEST_F(SickScannerTest, ADirtyWindowAndAnErrorAreReportedAndScansGoOn) {
  start();
  SickTelegram telegram;
  telegram.state = "0 2";
  fake_.scan(telegram);
  EXPECT_EQ(probe_.warnings.take(), "dirty_window");
  telegram.state = "0 1";
  fake_.scan(telegram);
  EXPECT_EQ(probe_.warnings.take(), "device_error");
  probe_.measurements.take();
  EXPECT_EQ(probe_.measurements.take().scan().ranges.size(), 4U);
}

}  // namespace
}  // namespace datmo::sick_scanner_test
