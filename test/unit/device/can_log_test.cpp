// SPDX-License-Identifier: BSD-3-Clause
// Logs of candump: their lines, and when their frames are delivered.
#include "datmo_fusion/device/can_log.h"

#include <chrono>
#include <fstream>

#include "device/can_samples.h"
#include "device/device_reason.h"
#include <gtest/gtest.h>

namespace datmo::can_log_test {
namespace {

using samples::reasonOf;

TEST(CanLogTest, LinesOfAllKindsOfFramesAreRead) {
  const auto standard = canLogLine("(1436509052.249713) vcan0 044#2A366C2BBA\r");
  ASSERT_TRUE(standard);
  EXPECT_NEAR(standard->time, 1436509052.249713, 1e-6);
  EXPECT_EQ(standard->interface, "vcan0");
  EXPECT_EQ(standard->frame.id.number, 0x44U);
  EXPECT_FALSE(standard->frame.id.is_extended);
  EXPECT_EQ(standard->frame.size, 5);
  EXPECT_EQ(standard->frame.data[4], 0xBA);
  const auto extended = canLogLine("(0.5) can1 00000044#00 R");
  ASSERT_TRUE(extended);
  EXPECT_TRUE(extended->frame.id.is_extended);
  const auto flexible = canLogLine("(0.5) can1 123##1" + std::string(128, 'f'));
  ASSERT_TRUE(flexible);
  EXPECT_EQ(flexible->frame.size, 64);
  EXPECT_EQ(flexible->frame.data[63], 0xFF);
  EXPECT_EQ(canLogLine("(0.5) can1 123#")->frame.size, 0);
  EXPECT_EQ(canLogLine("(0.5) can1 123#0011223344556677_9")->frame.size, 8);
  const auto error = canLogLine("(0.5) can1 20000040#0000000000000000");
  ASSERT_TRUE(error && error->frame.error);
  EXPECT_EQ(*error->frame.error, 0x40U);
  EXPECT_FALSE(canLogLine("(0.5) can1 123#R"));
  EXPECT_FALSE(canLogLine("(0.5) can1 123#R8"));
  EXPECT_FALSE(canLogLine("  "));
}

TEST(CanLogTest, InvalidLinesAreRefused) {
  for (const char* line :
       {"can0 123#00", "(now) can0 123#00", "(1.2.3) can0 123#00",
        "(99999999999999999999) can0 123#00", "(1.2.3.4) can0", "() can0 123#00", "(1.0) can0",
        "(1.0) can0 1234#00", "(1.0) can0 12G#00", "(1.0) can0 123#0", "(1.0) can0 123#0G",
        "(1.0) can0 123#001122334455667788", "(1.0) can0 123##", "(1.0) can0  123   [8]  11 22",
        "(1.0) can0 123##1"
        "0"}) {
    EXPECT_EQ(reasonOf([line] { canLogLine(line); }), "bad_frame") << line;
  }
}

TEST(CanLogTest, FramesAreDeliveredAtTheirRateAndThenTheEnd) {
  const std::string file = testing::TempDir() + "can_log_test.log";
  std::ofstream(file) << "(1000.0) can0 1A0#01\n(1000.01) can1 1A0#02\n\nbroken\n"
                         "(1000.05) can0 1A0#03\n(3.0) can0 1A0#04\n";
  const std::atomic<bool> stop{false};
  CanLog log(file, "can0", stop);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(log.next().data[0], 1);
  EXPECT_EQ(reasonOf([&] { log.next(); }), "bad_frame");
  EXPECT_EQ(log.next().data[0], 3);
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(49));
  EXPECT_EQ(log.next().data[0], 4);  // another recording, appended to it
  try {
    log.next();
    FAIL() << "it is at its end";
  } catch (const RecordingEnd& end) {
    EXPECT_NE(std::string(end.what()).find("frames of can1 are not of can0"), std::string::npos);
  }
  CanLog all(file, "", stop);
  all.next();
  EXPECT_EQ(all.next().data[0], 2);
  EXPECT_EQ(reasonOf([&] { CanLog("/nowhere.log", "", stop); }), "bad_recording");
}

TEST(CanLogTest, ItStopsWhileItWaits) {
  const std::string file = testing::TempDir() + "can_log_stop_test.log";
  std::ofstream(file) << "(1000.0) can0 1A0#01\n(9000.0) can0 1A0#02\n";
  std::atomic<bool> stop{false};
  CanLog log(file, "", stop);
  log.next();
  stop = true;
  EXPECT_THROW(log.next(), DeviceStopped);
}

}  // namespace
}  // namespace datmo::can_log_test
