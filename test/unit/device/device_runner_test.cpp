// SPDX-License-Identifier: BSD-3-Clause
// Common to all devices: nobody listening, and options that are out of range.
#include "datmo_fusion/device/device_runner.h"

#include <chrono>

#include "device/device_probe.h"
#include "device/fake_server.h"
#include <gtest/gtest.h>

namespace datmo::device_runner_test {
namespace {

using samples::DeviceProbe;
using samples::FakeServer;
using samples::UnusedPort;

class DeviceRunnerTest : public testing::TestWithParam<DeviceKind> {};

TEST_P(DeviceRunnerTest, ARefusedConnectionIsReportedAndRetried) {
  const UnusedPort unused;
  DeviceProbe probe(GetParam());
  probe.start(unused.port());
  EXPECT_EQ(probe.faults.take(), "no_connection");
  EXPECT_EQ(probe.faults.take(), "no_connection");
}

TEST_P(DeviceRunnerTest, ASilentDeviceIsConnectedAgain) {
  FakeServer fake;
  DeviceProbe probe(GetParam());
  probe.setup.timeout = 0.05;
  probe.start(fake.port());
  fake.accept();
  EXPECT_EQ(probe.faults.take(), "silent_device");
  fake.accept();
}

TEST_P(DeviceRunnerTest, ItEndsImmediatelyWhileItWaits) {
  FakeServer fake;
  DeviceProbe probe(GetParam());
  probe.start(fake.port());
  fake.accept();
  const auto begin = std::chrono::steady_clock::now();
  probe.stop();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(took.count(), 0.5 * probe.setup.timeout) << "it has waited for the device's timeout";
}

INSTANTIATE_TEST_SUITE_P(Makes, DeviceRunnerTest,
                         testing::Values(DeviceKind::kHokuyo, DeviceKind::kSickLms,
                                         DeviceKind::kNmea));

TEST(DeviceSetupTest, OptionsOutOfRangeAreRefused) {
  DeviceSetup setup;
  setup.port = 65536;
  EXPECT_THROW(deviceMaker(setup), OptionError);
  setup = DeviceSetup();
  setup.runner.min_backoff = 0.0;
  EXPECT_THROW(deviceMaker(setup), OptionError);
}

}  // namespace
}  // namespace datmo::device_runner_test
