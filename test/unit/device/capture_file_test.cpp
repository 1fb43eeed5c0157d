// SPDX-License-Identifier: BSD-3-Clause
// Network captures: which datagrams they contain, and when these are delivered.
#include "datmo_fusion/device/capture_file.h"

#include <filesystem>
#include <fstream>

#include "device/capture_sample.h"
#include "device/device_reason.h"
#include <gtest/gtest.h>
#include <pcap/pcap.h>

namespace datmo::capture_file_test {
namespace {

using samples::CapturedDatagram;
using samples::ethernetFrame;
using samples::reasonOf;
using samples::writeCapture;

constexpr int kPort = 2368;

TEST(DatagramTest, TheDataOfADatagramToThePortAreFound) {
  const std::string frame = ethernetFrame({0.0, kPort, "data"});
  EXPECT_EQ(datagramOf(frame, DLT_EN10MB, kPort), "data");
  EXPECT_EQ(datagramOf(frame + "padding", DLT_EN10MB, kPort), "data");
  EXPECT_FALSE(datagramOf(frame, DLT_EN10MB, kPort + 1));
  EXPECT_EQ(datagramOf(frame.substr(14), DLT_RAW, kPort), "data");
  const std::string tag("\x81\x00\x00\x05", 4);
  EXPECT_EQ(datagramOf(frame.substr(0, 12) + tag + frame.substr(12), DLT_EN10MB, kPort), "data");
  EXPECT_EQ(datagramOf(std::string(14, '\0') + frame.substr(12), DLT_LINUX_SLL, kPort), "data");
  const std::string ip("\x08\x00", 2);
  const std::string rest(18, '\0');
  EXPECT_EQ(datagramOf(ip + rest + frame.substr(14), DLT_LINUX_SLL2, kPort), "data");
  const std::string vlan("\x81\x00", 2);
  EXPECT_EQ(datagramOf(vlan + rest + tag.substr(2) + ip + frame.substr(14), DLT_LINUX_SLL2, kPort),
            "data");
}

TEST(DatagramTest, TruncatedFramesAndFragmentsAreIgnored) {
  const std::string frame = ethernetFrame({0.0, kPort, "data"});
  for (std::size_t length = 0; length < frame.size(); ++length) {
    EXPECT_FALSE(datagramOf(frame.substr(0, length), DLT_EN10MB, kPort)) << length;
  }
  std::string fragment = frame;
  fragment[14 + 6] = '\x20';
  EXPECT_FALSE(datagramOf(fragment, DLT_EN10MB, kPort));
  std::string tcp = frame;
  tcp[14 + 9] = 6;
  EXPECT_FALSE(datagramOf(tcp, DLT_EN10MB, kPort));
  EXPECT_FALSE(datagramOf(frame, DLT_IEEE802_11, kPort));
}

TEST(CaptureFileTest, DatagramsAreDeliveredAtTheirRateAndThenTheEnd) {
  const std::string file = testing::TempDir() + "capture_file_test.pcap";
  writeCapture(file, {{1000.0, kPort, "a"}, {1000.01, 8308, "position"}, {1000.05, kPort, "b"}});
  const std::atomic<bool> stop{false};
  CaptureFile capture(file, kPort, stop);
  EXPECT_EQ(capture.next(), "a");
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(capture.next(), "b");
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(49));
  EXPECT_EQ(reasonOf([&] { capture.next(); }), "recording_end");
}

TEST(CaptureFileTest, ItStopsWhileItWaits) {
  const std::string file = testing::TempDir() + "capture_file_stop_test.pcap";
  writeCapture(file, {{1000.0, kPort, "a"}, {1000000.0, kPort, "b"}});
  std::atomic<bool> stop{false};
  CaptureFile capture(file, kPort, stop);
  EXPECT_EQ(capture.next(), "a");
  stop = true;
  EXPECT_THROW(capture.next(), DeviceStopped);
}

TEST(CaptureFileTest, FramesOfAnotherKindAreNamed) {
  const std::string file = testing::TempDir() + "capture_file_link_test.pcap";
  writeCapture(file, {{1000.0, kPort, "a"}}, DLT_IEEE802_11);
  const std::atomic<bool> stop{false};
  try {
    CaptureFile(file, kPort, stop);
    FAIL() << "expected a refusal";
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("IEEE802_11"), std::string::npos) << error.what();
  }
}

TEST(CaptureFileTest, InvalidAndTruncatedFilesAreReported) {
  const std::atomic<bool> stop{false};
  EXPECT_EQ(reasonOf([&] { CaptureFile("/no/such/file", kPort, stop); }), "bad_recording");
  const std::string file = testing::TempDir() + "capture_file_cut_test.pcap";
  std::ofstream(file) << "no capture at all, but long enough for its head";
  EXPECT_EQ(reasonOf([&] { CaptureFile(file, kPort, stop); }), "bad_recording");
  writeCapture(file, {{1000.0, kPort, std::string(100, 'a')}});
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 20);
  CaptureFile capture(file, kPort, stop);
  EXPECT_EQ(reasonOf([&] { capture.next(); }), "bad_recording");
}

}  // namespace
}  // namespace datmo::capture_file_test
