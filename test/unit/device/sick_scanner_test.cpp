// SPDX-License-Identifier: BSD-3-Clause
// The client of a SICK scanner against a fake one on loopback.
#include "datmo_fusion/device/sick_scanner.h"

#include <cmath>

#include "device/device_probe.h"
#include "device/fake_sick.h"
#include <gtest/gtest.h>

namespace datmo::sick_scanner_test {
namespace {

using samples::bytesOf;
using samples::DeviceProbe;
using samples::FakeSick;
using samples::Measured;
using samples::SickTelegram;

class SickScannerTest : public testing::TestWithParam<ColaDialect> {
 protected:
  SickScannerTest() { fake_.dialect = GetParam(); }

  void connect() {
    fake_.accept();
    fake_.shakeHands();
    probe_.devices.take();
  }

  void start() {
    probe_.start(fake_.port());
    connect();
  }

  static bool isBinary() { return GetParam() == ColaDialect::kBinary; }

  /// Sends a scan stamped with a time of the scanner (us) that arrives at a time of the computer (s
  /// after the start), and returns the measurement.
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

  /// Answers the request for its state; 7: it is measuring.
  static std::string stateAnswer(char state) {
    return isBinary() ? bytesOf("sRA STlms \0") + state + bytesOf("\0\0\x08") + "00:00:14" +
                            bytesOf("\0\x08") + "01.01.00" + bytesOf("\0\0\0")
                      : std::string("sRA STlms ") + static_cast<char>('0' + state) +
                            " 0 8 00:00:14 8 01.01.00 0 0 0";
  }

  FakeSick fake_;
  DeviceProbe probe_{DeviceKind::kSickLms};
};

INSTANTIATE_TEST_SUITE_P(Dialects, SickScannerTest,
                         testing::Values(ColaDialect::kBinary, ColaDialect::kText));

TEST_P(SickScannerTest, AScanIsDeliveredAsSent) {
  start();
  const Measured scan = exchange(1, 1020000, 5.0);
  EXPECT_EQ(scan.scan().ranges.size(), 4U);
  EXPECT_EQ(scan.missed, 0U);
  EXPECT_NEAR(seconds(scan.stamp), 5.0 - 0.02, 1e-6);
}

TEST_P(SickScannerTest, SplitPacketsBecomeOneScan) {
  start();
  for (const char byte : colaFrame(SickTelegram().in(GetParam()))) {
    fake_.send(std::string(1, byte));
  }
  EXPECT_EQ(probe_.measurements.take().scan().ranges.size(), 4U);
}

TEST_P(SickScannerTest, MissingScansAreCountedAcrossTheCountersEnd) {
  start();
  EXPECT_EQ(exchange(0xFFFE, 1000000, 0.0).missed, 0U);
  EXPECT_EQ(exchange(0xFFFF, 1040000, 0.04).missed, 0U);
  EXPECT_EQ(exchange(2, 1160000, 0.16).missed, 2U);
}

TEST_P(SickScannerTest, StampsContinueWhenTheScannersClockWraps) {
  start();
  exchange(1, 0xFFFFFFFFU - 9999, 0.0);
  const Measured scan = exchange(2, 30000, 0.04);
  EXPECT_EQ(scan.clock.steps, 0U);
  EXPECT_NEAR(seconds(scan.stamp), 0.02, 1e-6);
}

TEST_P(SickScannerTest, DriftAndAStepOfTheClockAreFollowed) {
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

TEST_P(SickScannerTest, AScannerThatReturnsIsConnectedAgain) {
  start();
  exchange(100, 5000000, 0.0);
  fake_.send(colaFrame(SickTelegram().in(GetParam())).substr(0, 20));
  fake_.close();
  EXPECT_EQ(probe_.faults.take(), "lost_connection");
  connect();
  const Measured scan = exchange(3, 40000, 2.0);  // it was switched off: its clock restarts
  EXPECT_EQ(scan.missed, 0U);
  EXPECT_NEAR(seconds(scan.stamp), 2.0 - 0.02, 1e-6);
}

TEST_P(SickScannerTest, AWrongScanIsOneFaultAndAnotherConnection) {
  start();
  fake_.answer(SickTelegram().in(GetParam()).bytes.substr(0, 30));
  EXPECT_EQ(probe_.faults.take(), "bad_answer");
  connect();
  fake_.answer("sFA 7");
  EXPECT_EQ(probe_.faults.take(), "device_fault");
  connect();
  EXPECT_EQ(exchange(1, 1000000, 0.0).scan().ranges.size(), 4U);
}

TEST_P(SickScannerTest, OtherTelegramsAreSkipped) {
  start();
  fake_.answer(isBinary() ? bytesOf("sSN LMDscandatamon \0\x01") : "sSN LMDscandatamon 1");
  EXPECT_EQ(exchange(1, 1000000, 0.0).missed, 0U);
  EXPECT_TRUE(probe_.faults.isEmpty());
}

TEST_P(SickScannerTest, ScansOfAnOldConnectionAreSkipped) {
  probe_.start(fake_.port());
  fake_.accept();
  fake_.command();
  fake_.scan(SickTelegram());
  fake_.answer(fake_.goodAnswer("sRN DeviceIdent", "LMS111"));
  fake_.shakeHands();
  EXPECT_EQ(probe_.devices.take(),
            isBinary() ? "LMS111 at 127.0.0.1, CoLa B" : "LMS111 at 127.0.0.1, CoLa A");
}

TEST_P(SickScannerTest, AnotherModelIsRefused) {
  probe_.start(fake_.port());
  fake_.accept();
  fake_.shakeHands("NAV310");
  EXPECT_EQ(probe_.faults.take(), "wrong_device");
}

TEST_P(SickScannerTest, AnErrorAnswerIsReported) {
  probe_.start(fake_.port());
  fake_.accept();
  fake_.command();
  fake_.answer("sFA 3");
  EXPECT_EQ(probe_.faults.take(), "device_fault");
}

TEST_P(SickScannerTest, APasswordThatWasChangedIsReported) {
  probe_.start(fake_.port());
  fake_.accept();
  fake_.answer(fake_.goodAnswer(fake_.command(), "LMS111"));
  fake_.command();
  fake_.answer(isBinary() ? bytesOf("sAN SetAccessMode \0") : "sAN SetAccessMode 0");
  EXPECT_EQ(probe_.faults.take(), "device_fault");
}

TEST_P(SickScannerTest, SilenceIsNoFaultWhileItWarmsUp) {
  probe_.setup.timeout = 0.5;
  start();
  EXPECT_EQ(fake_.command(), "sRN STlms");
  fake_.send(colaFrame({GetParam(), stateAnswer(5)}) + colaFrame(SickTelegram().in(GetParam())));
  EXPECT_EQ(probe_.warnings.take(), "warming_up");
  EXPECT_EQ(probe_.measurements.take().scan().ranges.size(), 4U);
  EXPECT_EQ(fake_.command(), "sRN STlms");
  fake_.answer(stateAnswer(7));
  EXPECT_EQ(probe_.faults.take(), "silent_device");
}

TEST_P(SickScannerTest, ADirtyWindowAndAnErrorAreReportedAndScansContinue) {
  start();
  SickTelegram telegram;
  telegram.state = 2;
  fake_.scan(telegram);
  EXPECT_EQ(probe_.warnings.take(), "dirty_window");
  telegram.state = 1;
  fake_.scan(telegram);
  EXPECT_EQ(probe_.warnings.take(), "device_error");
  probe_.measurements.take();
  EXPECT_EQ(probe_.measurements.take().scan().ranges.size(), 4U);
}

}  // namespace
}  // namespace datmo::sick_scanner_test
