// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>

#include "datmo_fusion/device/device_clock.h"
#include "datmo_fusion/device/device_data.h"
#include "datmo_fusion/device/device_error.h"
#include "datmo_fusion/device/event_queue.h"

namespace datmo {

struct DeviceConnected {
  std::string device;  ///< readable description
};

struct DeviceFault {
  DeviceError error;  ///< which ended the connection
};

struct DeviceWarning {
  DeviceError error;  ///< which did not
};

struct DeviceMeasured {
  DeviceMeasurement measurement;
  ClockState clock;
};

using DeviceEvent = std::variant<DeviceConnected, DeviceFault, DeviceWarning, DeviceMeasured>;

/// What a device's thread reports to another thread: newer measurements and warnings replace older
/// ones.
using DeviceEventQueue = EventQueue<DeviceEvent, DeviceMeasured, DeviceWarning>;

}  // namespace datmo
