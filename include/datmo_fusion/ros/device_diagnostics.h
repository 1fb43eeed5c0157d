// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/device/device_clock.h"
#include "datmo_fusion/device/device_data.h"
#include "datmo_fusion/device/device_error.h"
#include "datmo_fusion/ros/stage/stage_monitor.h"

namespace datmo {

/// Diagnostics of a device: connections, faults by reason, measurements and missing ones, and the
/// device's clock. `now`: ROS time.
class DeviceDiagnostics {
 public:
  /// `monitor` must outlive it.
  explicit DeviceDiagnostics(StageMonitor& monitor);

  /// `device`: description for people.
  void connected(const std::string& device, Stamp now);

  /// Reports a fault, whether or not it ended the connection.
  void fault(const DeviceError& error, Stamp now);
  void warning(const DeviceError& error, Stamp now);

  /// `discarded`: total number of measurements dropped because they waited too long. Throws
  /// InputError (`no_ros_time`) for a measurement from before ROS time has begun.
  void measured(const DeviceMeasurement& measurement, const ClockState& clock,
                std::uint64_t discarded, Stamp now);

 private:
  void noteMissed(const DeviceMeasurement& measurement);
  void noteBus(const VehicleTwist& twist, Stamp stamp);
  void noteClock(const ClockState& clock);

  StageMonitor& monitor_;
  std::uint64_t connections_ = 0;
  std::uint64_t missed_ = 0;
  std::uint64_t clock_steps_ = 0;
  std::optional<double> first_offset_;  ///< s, of this connection
  std::optional<Stamp> last_twist_;     ///< of this connection
  double longest_gap_ = 0.0;            ///< s, of this connection, between two twists
};

}  // namespace datmo
