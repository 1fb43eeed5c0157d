// SPDX-License-Identifier: BSD-3-Clause
// A scanner on USB or a serial port, simulated by a pseudo terminal.
#include <memory>

#include "device/device_probe.h"
#include "device/fake_hokuyo.h"
#include "device/fake_serial.h"
#include <gtest/gtest.h>

namespace datmo::hokuyo_serial_test {
namespace {

using samples::DeviceProbe;
using samples::FakeHokuyo;
using samples::FakeSerial;

class HokuyoSerialTest : public testing::Test {
 protected:
  void start() {
    probe_.setup.address = serial_->file();
    probe_.start(0);
  }

  /// Answers the next command, which must be this one.
  void answer(const std::string& command, const std::string& status,
              const std::vector<std::string>& lines = {}) {
    ASSERT_EQ(serial_->receive('\n'), command);
    serial_->send(FakeHokuyo::answerText(command, status, lines));
  }

  /// Answers everything after SCIP2.0 and QT.
  void begin() {
    answer("PP", "00", FakeHokuyo::kModel);
    answer("BM", "00");
    answer("MD0006001001000", "00");
  }

  void expectScan() {
    serial_->send(FakeHokuyo::scan(100, {1000, 2000, 3000, 4000, 5000}));
    EXPECT_EQ(probe_.measurements.take().scan().ranges,
              (std::vector<float>{1.0F, 2.0F, 3.0F, 4.0F, 5.0F}));
  }

  std::unique_ptr<FakeSerial> serial_ = std::make_unique<FakeSerial>();
  DeviceProbe probe_{DeviceKind::kHokuyo};
};

TEST_F(HokuyoSerialTest, OldFirmwareIsSwitchedToTheProtocol) {
  start();
  ASSERT_EQ(serial_->receive('\n'), "SCIP2.0");
  serial_->send("SCIP2.0\n0\n\n");  // as SCIP 1.1 answers
  answer("QT", "00");
  begin();
  EXPECT_EQ(probe_.devices.take(), "UST-10LX, 5 beams, at " + serial_->file());
  EXPECT_EQ(serial_->speed(), static_cast<speed_t>(B115200));
  expectScan();
}

TEST_F(HokuyoSerialTest, OneThatIsStillSendingIsStopped) {
  start();
  ASSERT_EQ(serial_->receive('\n'), "SCIP2.0");
  const std::string scan = FakeHokuyo::scan(50, {1000, 2000, 3000, 4000, 5000});
  serial_->send(scan.substr(20) + scan + FakeHokuyo::answerText("SCIP2.0", "0E") + scan);
  answer("QT", "00");
  begin();
  expectScan();
  EXPECT_TRUE(probe_.faults.isEmpty());
}

TEST_F(HokuyoSerialTest, AnUnpluggedOneIsReported) {
  start();
  ASSERT_EQ(serial_->receive('\n'), "SCIP2.0");
  answer("QT", "00");
  begin();
  expectScan();
  serial_.reset();
  EXPECT_EQ(probe_.faults.take(), "lost_connection");
  EXPECT_EQ(probe_.faults.take(), "no_connection");
}

TEST_F(HokuyoSerialTest, AnotherDeviceIsReported) {
  start();
  ASSERT_EQ(serial_->receive('\n'), "SCIP2.0");
  for (int i = 0; i < 100; ++i) {
    serial_->send("$GPTXT,hello\n\n");
  }
  EXPECT_EQ(probe_.faults.take(), "bad_answer");
}

TEST_F(HokuyoSerialTest, ASilentOneIsReported) {
  probe_.setup.timeout = 0.05;
  start();
  EXPECT_EQ(probe_.faults.take(), "silent_device");
}

}  // namespace
}  // namespace datmo::hokuyo_serial_test
