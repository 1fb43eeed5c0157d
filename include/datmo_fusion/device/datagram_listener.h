// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string_view>
#include <thread>

#include "datmo_fusion/device/connection.h"
#include "datmo_fusion/device/device_error.h"

namespace datmo {

/// Callbacks of a DatagramListener, all called from its thread.
struct DatagramHandlers {
  std::function<void()> listening;
  std::function<void(std::string_view bytes)> received;
  std::function<void(const DeviceError& error)> fault;  ///< it listens again after a second
};

/// Listens to a UDP port in a thread of its own during its lifetime. Silence is not a fault: unlike
/// a device, other stations come and go.
class DatagramListener {
 public:
  /// `source`: the port and the sender; without a host, any sender. Its timeout is ignored.
  DatagramListener(const DeviceAddress& source, DatagramHandlers handlers);
  ~DatagramListener();
  DatagramListener(const DatagramListener&) = delete;
  DatagramListener& operator=(const DatagramListener&) = delete;

 private:
  void run();
  /// Listens until a fault (DeviceError) or a request to stop (DeviceStopped).
  void listen();

  DeviceAddress source_;
  DatagramHandlers handlers_;
  std::mutex mutex_;
  std::condition_variable stopped_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace datmo
