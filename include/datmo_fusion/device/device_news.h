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

using DeviceNews = std::variant<DeviceConnected, DeviceFault, DeviceWarning, DeviceMeasured>;

/// What a device's thread reports to another thread. Measurements and warnings that nobody
/// takes are overtaken by newer ones; reports on the connection are rare, and kept. Thread safe.
class DeviceNewsQueue {
 public:
  /// `longest`: measurements that wait at most, and as many warnings.
  explicit DeviceNewsQueue(std::size_t longest) : longest_(longest) {}

  void put(DeviceNews news);

  struct Taken {
    std::deque<DeviceNews> news;  ///< in their order
    std::uint64_t overtaken = 0;  ///< measurements, ever
  };
  /// All that waits.
  Taken takeAll();

 private:
  std::size_t longest_;
  std::mutex mutex_;
  std::deque<DeviceNews> news_;
  std::uint64_t overtaken_ = 0;
};

}  // namespace datmo
