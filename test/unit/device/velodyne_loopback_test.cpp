// SPDX-License-Identifier: BSD-3-Clause
// A Velodyne lidar on loopback, and a recording of one, with the thread that serves them.
#include <string>
#include <thread>
#include <vector>

#include "device/capture_sample.h"
#include "device/device_probe.h"
#include "device/fake_lidar.h"
#include "device/velodyne_packets.h"
#include <gtest/gtest.h>

namespace datmo::velodyne_loopback_test {
namespace {

using samples::DeviceProbe;
using samples::FakeLidar;
using samples::VelodyneSample;
using samples::VelodyneStream;

const DeviceCloud& cloudOf(const samples::Measured& measured) {
  return std::get<DeviceCloud>(measured.data);
}

class VelodyneLoopbackTest : public testing::Test {
 protected:
  VelodyneLoopbackTest() { probe_.setup.address = ""; }

  /// Sends the next packets until a measurement is queued; losses by the network or the machine do
  /// not matter.
  template <typename Box>
  void sendUntil(Box& box, const FakeLidar& lidar) {
    while (box.isEmpty()) {
      probe_.host = stream_.time() * 1e-6;
      lidar.send(stream_.next());
      std::this_thread::yield();
    }
  }

  DeviceProbe probe_{DeviceKind::kVelodyne};
  VelodyneStream stream_{VelodyneSample()};
};

TEST_F(VelodyneLoopbackTest, ALidarThatReturnsIsServedAgain) {
  const int port = FakeLidar::freePort();
  const FakeLidar lidar(port);
  probe_.setup.timeout = 0.05;
  probe_.start(port);
  EXPECT_EQ(probe_.faults.take(), "silent_device");
  sendUntil(probe_.measurements, lidar);
  EXPECT_EQ(probe_.devices.take(), "VLP-16, one return");
  EXPECT_FALSE(cloudOf(probe_.measurements.take()).points.empty());
  while (probe_.faults.take() != "silent_device") {
  }
  while (!probe_.measurements.isEmpty()) {
    probe_.measurements.take();
  }
  sendUntil(probe_.measurements, lidar);
  EXPECT_FALSE(cloudOf(probe_.measurements.take()).points.empty());
}

TEST_F(VelodyneLoopbackTest, PacketsOfAnotherSenderAreIgnored) {
  const int port = FakeLidar::freePort();
  const FakeLidar lidar(port);
  probe_.setup.timeout = 0.05;
  probe_.setup.address = "127.0.0.2";
  probe_.start(port);
  sendUntil(probe_.faults, lidar);
  EXPECT_EQ(probe_.faults.take(), "silent_device");
  EXPECT_TRUE(probe_.devices.isEmpty());
}

TEST_F(VelodyneLoopbackTest, APortInUseIsReported) {
  const int port = FakeLidar::freePort();
  DeviceProbe first(DeviceKind::kVelodyne);
  first.setup.address = "";
  first.setup.timeout = 0.05;
  first.start(port);
  first.faults.take();  // it keeps trying to listen
  probe_.setup.timeout = 0.05;
  probe_.start(port);
  constexpr int kFaults = 100;  // of other kinds, before it
  int others = 0;
  while (probe_.faults.take() != "no_connection" && others < kFaults) {
    ++others;
  }
  EXPECT_LT(others, kFaults);
}

TEST_F(VelodyneLoopbackTest, ARecordingIsPlayedToItsEnd) {
  std::vector<samples::CapturedDatagram> packets;
  for (int i = 0; i < 3 * stream_.packetsPerTurn(); ++i) {
    packets.push_back({stream_.time() * 1e-6, 2368, stream_.next()});
  }
  probe_.setup.recording = testing::TempDir() + "velodyne_loopback_test.pcap";
  samples::writeCapture(probe_.setup.recording, packets);
  probe_.start(0);
  EXPECT_EQ(probe_.devices.take(), "VLP-16, one return");
  EXPECT_EQ(cloudOf(probe_.measurements.take()).points.size(), 900U * 32U);
  EXPECT_EQ(cloudOf(probe_.measurements.take()).points.size(), 900U * 32U);
  EXPECT_EQ(probe_.faults.take(), "recording_end");
}

}  // namespace
}  // namespace datmo::velodyne_loopback_test
