// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <variant>

#include "datmo_fusion/device/device_clock.h"
#include "datmo_fusion/device/device_data.h"
#include "datmo_fusion/device/device_error.h"

namespace datmo {

struct DeviceConnected {
  std::string device;  ///< what it is, for people
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

/// What a device's thread reports to another thread. If nobody takes them, newer measurements and
/// warnings replace older ones; reports on the connection are rare, and kept. Thread safe.
class DeviceEventQueue {
 public:
  /// `longest`: measurements that wait at most, and as many warnings.
  explicit DeviceEventQueue(std::size_t longest) : longest_(longest) {}

  void put(DeviceEvent event);

  struct Taken {
    std::deque<DeviceEvent> events;  ///< in their order
    std::uint64_t discarded = 0;     ///< measurements, ever
  };
  /// All that waits.
  Taken takeAll();

 private:
  std::size_t longest_;
  std::mutex mutex_;
  std::deque<DeviceEvent> events_;
  std::uint64_t discarded_ = 0;
};

}  // namespace datmo
