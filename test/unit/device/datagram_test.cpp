// SPDX-License-Identifier: BSD-3-Clause
// Datagrams over loopback, with the receiving thread.
#include <memory>
#include <string>
#include <thread>

#include "device/device_probe.h"
#include "device/fake_lidar.h"
#include <gtest/gtest.h>

#include "datmo_fusion/device/datagram_listener.h"
#include "datmo_fusion/device/datagram_sender.h"

namespace datmo::datagram_test {
namespace {

using samples::FakeLidar;
using samples::Mailbox;

class DatagramLoopbackTest : public testing::Test {
 protected:
  std::unique_ptr<DatagramListener> listen(const std::string& source = "") {
    DatagramHandlers handlers;
    handlers.listening = [this] { listening_.put(true); };
    handlers.received = [this](std::string_view bytes) { received_.put(std::string(bytes)); };
    handlers.fault = [this](const DeviceError& error) { faults_.put(error.reason()); };
    return std::make_unique<DatagramListener>(DeviceAddress{source, port_}, handlers);
  }

  /// Sends as soon as the name is looked up, which may take longer on a busy machine.
  static void sendOnceKnown(DatagramDestination& destination, const std::string& bytes) {
    while (!destination.send(bytes)) {
      std::this_thread::yield();
    }
  }

  int port_ = FakeLidar::freePort();
  Mailbox<bool> listening_;
  Mailbox<std::string> received_;
  Mailbox<std::string> faults_;
};

TEST_F(DatagramLoopbackTest, SentDatagramsAreReceived) {
  const auto listener = listen("127.0.0.1");
  EXPECT_TRUE(listening_.take());
  const DatagramSender sender("localhost", port_);
  sender.send(std::string("\x02\x00\xFF", 3));
  EXPECT_EQ(received_.take(), std::string("\x02\x00\xFF", 3));
  sender.send("second");
  EXPECT_EQ(received_.take(), "second");
}

TEST_F(DatagramLoopbackTest, WithoutListenerNothingFails) {
  const DatagramSender sender("127.0.0.1", port_);
  for (int i = 0; i < 10; ++i) {
    EXPECT_NO_THROW(sender.send("to nobody"));
  }
  const auto listener = listen();
  EXPECT_TRUE(listening_.take());
  sender.send("to somebody");
  EXPECT_EQ(received_.take(), "to somebody");
}

TEST_F(DatagramLoopbackTest, OverlongDatagramsAreNotSent) {
  const DatagramSender sender("127.0.0.1", port_);
  EXPECT_THROW(sender.send(std::string(70000, 'a')), DeviceError);
}

TEST_F(DatagramLoopbackTest, APortInUseIsAFault) {
  const auto first = listen();
  EXPECT_TRUE(listening_.take());
  const auto second = listen();
  EXPECT_EQ(faults_.take(), "no_connection");
}

TEST_F(DatagramLoopbackTest, AnInvalidNameIsAFault) {
  EXPECT_THROW(DatagramSender("no host is named so", port_), DeviceError);
  const auto listener = listen("no host is named so");
  EXPECT_EQ(faults_.take(), "no_connection");
}

TEST_F(DatagramLoopbackTest, ANameIsLookedUpAtTheFirstDatagramAndAgainAfterAPause) {
  constexpr double kLong = 3600.0;  // s
  DatagramDestination unknown("no host is named so", port_, kLong);
  EXPECT_THROW(sendOnceKnown(unknown, "first"), DeviceError);
  EXPECT_FALSE(unknown.send("in the pause"));
  DatagramDestination again("no host is named so", port_, 0.0);
  EXPECT_THROW(sendOnceKnown(again, "first"), DeviceError);
  EXPECT_THROW(sendOnceKnown(again, "second"), DeviceError);
  EXPECT_FALSE(DatagramDestination("", port_, 0.0).send("to nobody"));
  const auto listener = listen();
  EXPECT_TRUE(listening_.take());
  DatagramDestination known("localhost", port_, kLong);
  sendOnceKnown(known, "to somebody");
  EXPECT_EQ(received_.take(), "to somebody");
}

}  // namespace
}  // namespace datmo::datagram_test
