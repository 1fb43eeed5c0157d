// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "datmo_fusion/device/can_frame.h"
#include "datmo_fusion/device/can_motion.h"
#include "datmo_fusion/device/device.h"

namespace datmo {

/// Throws DeviceError.
using CanOpener = std::function<std::unique_ptr<CanSource>()>;

/// A vehicle that reports its motion on its CAN bus (CanMotion). Stamps are the kernel's times of
/// reception; a bus has no clock of its own.
class CanVehicle : public Device {
 public:
  /// `name`: of the bus, for messages. `timeout`: s without a motion, after which the bus is
  /// reopened; none for a recording, which is played once: neither a bus that was off nor invalid
  /// frames restart it. Throws OptionError.
  CanVehicle(CanOpener open, const Checked<CanOptions>& options, std::string name,
             std::optional<double> timeout, const DeviceHost& host);

  /// Returns after the first motion.
  std::string connect() override;
  DeviceMeasurement next() override;

 private:
  using Clock = std::chrono::steady_clock;

  /// Returns the next valid frame. Invalid ones are reported; many in a row are an error, and end a
  /// recording.
  CanFrame nextFrame();
  /// Throws DeviceError (`bus_off`) unless it is recorded; warns of other errors.
  void handleError(std::uint32_t error) const;
  DeviceMeasurement nextMotion();

  CanOpener open_;
  double delay_;  ///< s
  std::string name_;
  std::optional<double> timeout_;  ///< s; none: a recording
  DeviceHost host_;
  CanMotion motion_;
  std::unique_ptr<CanSource> source_;
  std::optional<DeviceMeasurement> pending_;  ///< the first one
  Clock::time_point last_motion_;
  std::uint64_t frames_ = 0;
};

}  // namespace datmo
