// SPDX-License-Identifier: BSD-3-Clause
// The diagnostic status of a device.
#include "datmo_fusion/ros/device_diagnostics.h"

#include <gtest/gtest.h>

namespace datmo::device_diagnostics_test {
namespace {

class DeviceDiagnosticsTest : public testing::Test {
 protected:
  double figure(const std::string& name) const { return monitor_.figures().at(name); }

  Stamp now_ = Stamp::fromSeconds(1000.0);
  StageMonitor monitor_{"/device"};
  DeviceDiagnostics diagnostics_{monitor_};
};

TEST_F(DeviceDiagnosticsTest, ItIsAnErrorUntilItIsConnectedAndAfterAFault) {
  EXPECT_EQ(monitor_.health(), HealthLevel::kNoOutput);
  diagnostics_.connected("a scanner", now_);
  EXPECT_EQ(monitor_.health(), HealthLevel::kOk);
  diagnostics_.fault(DeviceError("lost_connection", "it is gone"), now_);
  EXPECT_EQ(monitor_.health(), HealthLevel::kNoOutput);
  EXPECT_EQ(monitor_.healthReason(), "it is gone");
  EXPECT_EQ(monitor_.drops().at("lost_connection"), 1U);
  diagnostics_.connected("a scanner", now_);
  EXPECT_EQ(figure("connections"), 2.0);
}

TEST_F(DeviceDiagnosticsTest, LossesAreCountedByKind) {
  DeviceMeasurement cloud;
  cloud.stamp = now_;
  cloud.data = DeviceCloud();
  cloud.missed = 7;
  diagnostics_.measured(cloud, ClockState(), 3, now_);
  diagnostics_.measured(cloud, ClockState(), 3, now_);
  EXPECT_EQ(figure("packets missed"), 14.0);
  EXPECT_EQ(figure("measurements discarded"), 3.0);
  EXPECT_EQ(monitor_.warnings().at("missed_packets"), 2U);
  DeviceMeasurement scan;
  scan.stamp = now_;
  diagnostics_.measured(scan, ClockState(), 3, now_);
  EXPECT_EQ(monitor_.warnings().count("missed_scans"), 0U);
}

TEST_F(DeviceDiagnosticsTest, TheClockIsJudgedByWhatItGainsSinceItWasConnected) {
  diagnostics_.connected("a scanner", now_);
  DeviceMeasurement scan;
  scan.stamp = now_;
  diagnostics_.measured(scan, {1.7e9, 0.0, 0}, 0, now_);
  diagnostics_.measured(scan, {1.7e9 + 0.25, 1e-4, 1}, 0, now_);
  EXPECT_NEAR(figure("clock offset since connected [ms]"), 250.0, 1e-3);
  EXPECT_NEAR(figure("clock drift [ppm]"), 100.0, 1e-9);
  EXPECT_EQ(monitor_.warnings().at("clock_step"), 1U);
  diagnostics_.connected("a scanner", now_);
  diagnostics_.measured(scan, {5.0, 0.0, 1}, 0, now_);
  EXPECT_EQ(figure("clock offset since connected [ms]"), 0.0);
  EXPECT_EQ(monitor_.warnings().at("clock_step"), 1U);
}

TEST_F(DeviceDiagnosticsTest, BeforeRosTimeBeginsMeasurementsAreRefused) {
  DeviceMeasurement scan;
  const auto measure = [&](double stamp, double now) {
    scan.stamp = Stamp::fromSeconds(stamp);
    diagnostics_.measured(scan, ClockState(), 0, Stamp::fromSeconds(now));
  };
  EXPECT_THROW(measure(-0.025, 0.0), InputError);
  EXPECT_THROW(measure(-0.025, 1000.0), InputError) << "it waited while ROS time began";
  EXPECT_FALSE(monitor_.hasReceived("measurements"));
  EXPECT_NO_THROW(measure(999.975, 1000.0));
  EXPECT_TRUE(monitor_.hasReceived("measurements"));
}

TEST_F(DeviceDiagnosticsTest, VelocitiesDoNotCountAsPositions) {
  DeviceMeasurement fix;
  fix.data = SatelliteFix{SatelliteFix::Kind::kSatellites, 45.0, 5.0, 200.0, 3.0, 4.5, 9};
  DeviceMeasurement velocity;
  velocity.data = GroundVelocity();
  for (int i = 0; i < 10; ++i) {
    const Stamp now = now_ + 0.2 * i;
    fix.stamp = now;
    velocity.stamp = now;
    diagnostics_.measured(fix, ClockState(), 0, now);
    diagnostics_.measured(velocity, ClockState(), 0, now);
  }
  EXPECT_NEAR(figure("rate [Hz]"), 5.0, 1e-6);
  EXPECT_EQ(figure("satellites"), 9.0);
  EXPECT_EQ(figure("standard deviation [m]"), 3.0);
}

TEST_F(DeviceDiagnosticsTest, OfABusTheRateAndTheGapsAreReported) {
  diagnostics_.connected("a bus", now_);
  DeviceMeasurement twist;
  twist.data = VehicleTwist{1.0, 0.0, 42, {}, {}};
  for (int i = 0; i < 10; ++i) {
    const double time = 0.02 * i + (i > 4 ? 0.3 : 0.0);
    twist.stamp = now_ + time;
    twist.missed = i == 5 ? 15 : 0;
    diagnostics_.measured(twist, ClockState(), 0, now_ + time);
  }
  EXPECT_NEAR(figure("longest gap since connected [s]"), 0.32, 1e-6);
  EXPECT_EQ(figure("frames of other messages"), 42.0);
  EXPECT_EQ(figure("frames missed"), 15.0);
  EXPECT_EQ(monitor_.warnings().at("missed_frames"), 1U);
  EXPECT_GT(figure("rate [Hz]"), 10.0);
  diagnostics_.connected("a bus", now_);
  diagnostics_.measured(twist, ClockState(), 0, now_);
  EXPECT_EQ(figure("longest gap since connected [s]"), 0.0);
}

}  // namespace
}  // namespace datmo::device_diagnostics_test
