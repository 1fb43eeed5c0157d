// SPDX-License-Identifier: BSD-3-Clause
// A vehicle's bus, served by a device's thread from a log, and from a stand-in socket: datagrams
// that are frames in the kernel's layout.
#include "datmo_fusion/device/can_vehicle.h"

#include <array>
#include <atomic>
#include <fstream>
#include <thread>

#include "device/can_samples.h"
#include "device/device_probe.h"
#include "device/device_reason.h"
#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "datmo_fusion/device/can_socket.h"

namespace datmo::can_vehicle_test {
namespace {

using samples::canLogText;
using samples::DeviceProbe;
using samples::reasonOf;
using samples::speedFrame;
using samples::yawFrame;

const VehicleTwist& twistOf(const DeviceData& data) { return std::get<VehicleTwist>(data); }

class CanRecordingTest : public testing::Test {
 protected:
  void play(const std::string& lines) {
    std::ofstream(probe_.setup.recording) << lines;
    probe_.start(0);
  }

  CanRecordingTest() {
    probe_.setup.recording = testing::TempDir() + "can_vehicle_test.log";
    probe_.setup.address = "can0";
    probe_.setup.can = samples::canSample();
  }

  DeviceProbe probe_{DeviceKind::kCan};
};

TEST_F(CanRecordingTest, ItsMotionIsDeliveredAndItsEndIsReported) {
  probe_.setup.can.delay = 0.02;
  play(canLogText(1.0, yawFrame(10.0)) + canLogText(1.0, speedFrame(3.0, 0)) + "broken\n" +
       "(1.01) can0 20000008#0000000000000000\n" + canLogText(1.02, speedFrame(4.0, 1)) +
       canLogText(1.03, samples::canFrame(0x123, {1})) + canLogText(1.04, speedFrame(5.0, 4)));
  const samples::Measured first = probe_.measurements.take();
  EXPECT_NEAR(twistOf(first.data).speed, 4.0, 1e-9);
  EXPECT_NEAR(secondsBetween(Stamp::fromSeconds(DeviceProbe::kStart), first.stamp), -0.02, 1e-6);
  const samples::Measured second = probe_.measurements.take();
  EXPECT_NEAR(twistOf(second.data).yaw_rate, 0.174533, 1e-5);
  EXPECT_EQ(second.missed, 2U);
  EXPECT_EQ(twistOf(second.data).other_frames, 1U);
  EXPECT_EQ(probe_.devices.take(), "the CAN bus of " + probe_.setup.recording);
  EXPECT_EQ(probe_.warnings.take(), "bad_frame");
  EXPECT_EQ(probe_.warnings.take(), "bus_error");
  EXPECT_EQ(probe_.faults.take(), "recording_end");
}

TEST_F(CanRecordingTest, AGapInItIsNoReasonToStartOver) {
  probe_.setup.timeout = 0.05;
  play(canLogText(1.0, yawFrame(1.0)) + canLogText(1.0, speedFrame(3.0, 0)) +
       canLogText(1.0, speedFrame(3.0, 1)) + canLogText(1.2, samples::canFrame(0x123, {1})) +
       canLogText(1.2, speedFrame(4.0, 2)));
  probe_.measurements.take();
  EXPECT_NEAR(twistOf(probe_.measurements.take().data).speed, 4.0, 1e-9);
  EXPECT_EQ(probe_.faults.take(), "recording_end");
}

TEST_F(CanRecordingTest, AnotherVehiclesAndInvalidLogsAreReported) {
  play(canLogText(1.0, samples::canFrame(0x123, {1})));
  EXPECT_EQ(probe_.faults.take(), "recording_end");
  EXPECT_TRUE(probe_.devices.isEmpty());
  probe_.stop();
  std::string text;
  for (int i = 0; i < 100; ++i) {
    text += "no log\n";
  }
  play(text);
  EXPECT_EQ(probe_.faults.take(), "recording_end");
}

TEST_F(CanRecordingTest, ErrorsInItDoNotRestartIt) {
  std::string text = canLogText(1.0, yawFrame(1.0)) + canLogText(1.0, speedFrame(3.0, 0)) +
                     canLogText(1.0, speedFrame(3.0, 1)) +
                     "(1.0) can0 20000040#0000000000000000\n" + canLogText(1.0, speedFrame(4.0, 2));
  for (int i = 0; i < 21; ++i) {
    text += "broken\n";
  }
  play(text + canLogText(1.0, speedFrame(5.0, 3)));
  EXPECT_EQ(probe_.faults.take(), "recording_end");
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // ten times max_backoff
  probe_.stop();
  EXPECT_NEAR(twistOf(probe_.measurements.take().data).speed, 3.0, 1e-9);
  EXPECT_NEAR(twistOf(probe_.measurements.take().data).speed, 4.0, 1e-9);
  EXPECT_TRUE(probe_.measurements.isEmpty());
  EXPECT_TRUE(probe_.faults.isEmpty());
  EXPECT_EQ(probe_.warnings.take(), "bus_off");
}

/// Both ends of a socket: the vehicle's, and ours.
class CanBusTest : public testing::Test {
 protected:
  CanBusTest() {
    std::array<int, 2> ends{};
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    for (int& end : ends) {
      end = socket(AF_INET, SOCK_DGRAM, 0);
    }
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(bind(ends[0], any, size), 0);
    EXPECT_EQ(getsockname(ends[0], any, &size), 0);
    EXPECT_EQ(connect(ends[1], any, size), 0);
    vehicle_end_ = ends[0];
    our_end_ = ends[1];
  }

  ~CanBusTest() override { close(our_end_); }

  std::unique_ptr<CanSocket> bus(double timeout) {
    return std::make_unique<CanSocket>(vehicle_end_, "can0", timeout, stop_);
  }

  void sendBytes(const void* bytes, std::size_t size) const {
    ASSERT_EQ(send(our_end_, bytes, size, 0), static_cast<ssize_t>(size));
  }

  void sendFrame(const CanFrame& frame, std::uint32_t flags = 0) const {
    can_frame bytes{};
    bytes.can_id = frame.id.number | (frame.id.is_extended ? CAN_EFF_FLAG : 0U) | flags;
    bytes.can_dlc = frame.size;
    std::copy_n(frame.data.begin(), frame.size, bytes.data);
    sendBytes(&bytes, sizeof bytes);
  }

  DeviceHost host() {
    return {stop_, clock_,
            [this](const DeviceError& error) { warnings_.push_back(error.reason()); }};
  }

  std::unique_ptr<CanVehicle> vehicle(double timeout) {
    return std::make_unique<CanVehicle>([this, timeout] { return bus(timeout); },
                                        samples::canSample(), "can0", timeout, host());
  }

  std::atomic<bool> stop_{false};
  Stamp now_ = Stamp::fromSeconds(DeviceProbe::kStart);
  DeviceClock clock_{ClockOptions(), [this] { return now_; }};
  std::vector<std::string> warnings_;
  int vehicle_end_ = -1;
  int our_end_ = -1;
};

TEST_F(CanBusTest, AFrameHasTheTimeOfItsReception) {
  const auto socket = bus(60.0);
  CanFrame frame;
  for (int i = 0; i < 100 && frame.age < 0.05;
       ++i) {  // the first ones may be sent before the bus is on
    sendFrame(samples::canFrame(0x18FEF100, {1, 2, 3}));
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    frame = socket->next();
  }
  EXPECT_TRUE(frame.id.is_extended);
  EXPECT_EQ(frame.id.number, 0x18FEF100U);
  EXPECT_EQ(frame.size, 3);
  EXPECT_EQ(frame.data[2], 3);
  EXPECT_GE(frame.age, 0.05);
  EXPECT_LT(frame.age, 10.0);
}

TEST_F(CanBusTest, CanFdAndErrorFramesAreAcceptedAndOthersRefused) {
  const auto socket = bus(60.0);
  canfd_frame flexible{};
  flexible.can_id = 0x123;
  flexible.len = 12;
  flexible.data[11] = 7;
  sendBytes(&flexible, sizeof flexible);
  const CanFrame frame = socket->next();
  EXPECT_EQ(frame.size, 12);
  EXPECT_EQ(frame.data[11], 7);
  sendFrame(samples::canFrame(CAN_ERR_BUSOFF, {0}), CAN_ERR_FLAG);
  EXPECT_EQ(socket->next().error, std::optional<std::uint32_t>(CAN_ERR_BUSOFF));
  sendFrame(samples::canFrame(0x123, {1, 2}), CAN_RTR_FLAG);
  EXPECT_EQ(socket->next().size, 0);
  sendBytes(&flexible, 5);
  EXPECT_EQ(reasonOf([&] { socket->next(); }), "bad_frame");
  flexible.len = 65;
  sendBytes(&flexible, sizeof flexible);
  EXPECT_EQ(reasonOf([&] { socket->next(); }), "bad_frame");
  flexible.len = 9;  // more than a classic frame has
  sendBytes(&flexible, sizeof(can_frame));
  EXPECT_EQ(reasonOf([&] { socket->next(); }), "bad_frame");
}

TEST_F(CanBusTest, AVehiclesMotionIsDeliveredAndASilentBusIsReported) {
  const auto device = vehicle(0.3);
  sendFrame(yawFrame(1.0));
  sendFrame(speedFrame(5.0, 0));
  sendFrame(speedFrame(6.0, 1));
  EXPECT_EQ(device->connect(), "the CAN bus of can0");
  EXPECT_NEAR(twistOf(device->next().data).speed, 6.0, 1e-9);
  EXPECT_EQ(reasonOf([&] { device->next(); }), "silent_device");
}

TEST_F(CanBusTest, ABusOfOtherMessagesCountsAsSilent) {
  const auto device = vehicle(0.2);
  std::atomic<bool> is_done{false};
  std::thread others([&] {
    while (!is_done) {
      sendFrame(samples::canFrame(0x321, {1}));
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
  try {
    device->connect();
    ADD_FAILURE() << "it is connected";
  } catch (const DeviceError& error) {
    EXPECT_EQ(error.reason(), "silent_device");
    EXPECT_NE(std::string(error.what()).find("expected 0x1A0"), std::string::npos) << error.what();
  }
  is_done = true;
  others.join();
}

TEST_F(CanBusTest, ErrorsOfTheBusAreCountedAndBusOffEndsTheConnection) {
  const auto device = vehicle(60.0);
  sendFrame(samples::canFrame(CAN_ERR_PROT | CAN_ERR_ACK, {0}), CAN_ERR_FLAG);
  sendFrame(yawFrame(1.0));
  sendFrame(speedFrame(5.0, 0));
  sendFrame(speedFrame(5.0, 1));
  device->connect();
  EXPECT_EQ(warnings_, std::vector<std::string>{"bus_error"});
  device->next();
  sendFrame(samples::canFrame(CAN_ERR_BUSOFF, {0}), CAN_ERR_FLAG);
  EXPECT_EQ(reasonOf([&] { device->next(); }), "bus_off");
}

TEST_F(CanBusTest, ItStopsWhileItWaits) {
  const auto socket = bus(60.0);
  stop_ = true;
  EXPECT_THROW(socket->next(), DeviceStopped);
}

TEST(CanInterfaceTest, AMissingOneIsReported) {
  const std::atomic<bool> stop{false};
  EXPECT_EQ(reasonOf([&] { CanSocket::open("nocan7", 1.0, stop); }), "no_connection");
}

}  // namespace
}  // namespace datmo::can_vehicle_test
