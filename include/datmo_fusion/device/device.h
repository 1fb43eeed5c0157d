// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "datmo_fusion/device/device_clock.h"
#include "datmo_fusion/device/device_data.h"
#include "datmo_fusion/device/device_error.h"

namespace datmo {

/// What a device has of who serves it; all of it outlives the device.
struct DeviceHost {
  const std::atomic<bool>& stop;  ///< true ends all waiting by DeviceStopped
  DeviceClock& clock;             ///< to be restarted by each connection
  /// Something is wrong that does not end the connection.
  std::function<void(const DeviceError& error)> warn;
};

/// One connection with a device, by the protocol of its make. Whoever serves it connects anew by
/// another one.
class Device {
 public:
  virtual ~Device() = default;

  /// Returns what the device is, for people. Throws DeviceError, DeviceStopped.
  virtual std::string connect() = 0;

  /// Waits for what it measures next. Throws DeviceError, DeviceStopped.
  virtual DeviceMeasurement next() = 0;
};

}  // namespace datmo
