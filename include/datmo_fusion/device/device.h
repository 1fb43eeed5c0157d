// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "datmo_fusion/device/device_clock.h"
#include "datmo_fusion/device/device_data.h"
#include "datmo_fusion/device/device_error.h"

namespace datmo {

/// What the thread that serves a device provides; all of it outlives the device.
struct DeviceHost {
  const std::atomic<bool>& stop;  ///< true ends all waiting by DeviceStopped
  DeviceClock& clock;             ///< to be restarted for each connection
  /// Reports a fault that does not end the connection.
  std::function<void(const DeviceError& error)> warn;
};

/// One connection with a device, by the manufacturer's protocol. To reconnect, a new object is
/// created.
class Device {
 public:
  virtual ~Device() = default;

  /// Connects, and returns a readable description of the device. Throws DeviceError, DeviceStopped.
  virtual std::string connect() = 0;

  /// Waits for the next measurement. Throws DeviceError, DeviceStopped.
  virtual DeviceMeasurement next() = 0;
};

}  // namespace datmo
