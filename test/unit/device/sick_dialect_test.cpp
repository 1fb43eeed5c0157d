// SPDX-License-Identifier: BSD-3-Clause
// How the client of a SICK scanner detects its dialect, and what it does when that changes.
#include "device/device_probe.h"
#include "device/fake_sick.h"
#include <gtest/gtest.h>

#include "datmo_fusion/device/sick_scanner.h"

namespace datmo::sick_dialect_test {
namespace {

using samples::DeviceProbe;
using samples::FakeSick;
using samples::OtherDialect;
using samples::SickTelegram;

class SickDialectTest : public testing::Test {
 protected:
  void connect() {
    fake_.accept();
    fake_.shakeHands();
  }

  void expectAScan() {
    fake_.scan(SickTelegram());
    EXPECT_EQ(probe_.measurements.take().scan().ranges.size(), 4U);
  }

  FakeSick fake_;
  DeviceProbe probe_{DeviceKind::kSickLms};
};

TEST_F(SickDialectTest, AScannerThatIsSilentInBinaryIsAskedInText) {
  probe_.setup.timeout = 1.0;
  fake_.dialect = ColaDialect::kText;
  fake_.other = OtherDialect::kIsSilent;
  probe_.start(fake_.port());
  connect();
  EXPECT_EQ(probe_.devices.take(), "LMS10x_FieldEval at 127.0.0.1, CoLa A");
  expectAScan();
  EXPECT_TRUE(probe_.faults.isEmpty());
}

TEST_F(SickDialectTest, AScannerThatDisconnectsIsAskedInTheOther) {
  fake_.dialect = ColaDialect::kText;
  fake_.other = OtherDialect::kHangsUp;
  probe_.start(fake_.port());
  connect();
  expectAScan();
  EXPECT_TRUE(probe_.faults.isEmpty());
}

TEST_F(SickDialectTest, TheDetectedDialectIsTriedFirstOnTheNextConnection) {
  fake_.dialect = ColaDialect::kText;
  probe_.start(fake_.port());
  connect();
  expectAScan();
  fake_.close();
  EXPECT_EQ(probe_.faults.take(), "lost_connection");
  fake_.accept();
  EXPECT_EQ(fake_.receive('\x03'), "\x02sRN DeviceIdent");
}

TEST_F(SickDialectTest, ADialectSwitchedWhileOfflineIsDetected) {
  probe_.start(fake_.port());
  for (const ColaDialect dialect :
       {ColaDialect::kBinary, ColaDialect::kText, ColaDialect::kBinary}) {
    fake_.dialect = dialect;
    connect();
    expectAScan();
    fake_.close();
    EXPECT_EQ(probe_.faults.take(), "lost_connection");
  }
}

TEST_F(SickDialectTest, ADialectSwitchedWhileOnlineIsOneFault) {
  probe_.start(fake_.port());
  connect();
  expectAScan();
  for (const ColaDialect dialect : {ColaDialect::kText, ColaDialect::kBinary}) {
    fake_.dialect = dialect;
    fake_.scan(SickTelegram());
    EXPECT_EQ(probe_.faults.take(), "wrong_dialect");
    connect();
    expectAScan();
  }
  EXPECT_TRUE(probe_.faults.isEmpty());
}

TEST_F(SickDialectTest, AWrongChecksumIsOneFaultAndAnotherConnection) {
  probe_.start(fake_.port());
  connect();
  std::string bytes = colaFrame(SickTelegram().in(ColaDialect::kBinary));
  bytes[60] = static_cast<char>(bytes[60] ^ 1);
  fake_.send(bytes);
  EXPECT_EQ(probe_.faults.take(), "bad_answer");
  connect();
  expectAScan();
}

TEST_F(SickDialectTest, SilenceInBothNamesThem) {
  const std::atomic<bool> stop{false};
  DeviceClock clock(ClockOptions(), [] { return Stamp(); });
  SickScanner scanner({"127.0.0.1", fake_.port(), 0.05},
                      std::make_shared<ColaDialect>(ColaDialect::kBinary), {stop, clock, {}});
  try {
    scanner.connect();
    FAIL() << "expected a fault";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.reason(), "silent_device");
    EXPECT_NE(std::string(error.what()).find("in CoLa B and in CoLa A"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace datmo::sick_dialect_test
