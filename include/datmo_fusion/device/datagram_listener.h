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

/// What a DatagramListener tells, each from its thread.
struct DatagramHandlers {
  std::function<void()> listening;
  std::function<void(std::string_view bytes)> received;
  std::function<void(const DeviceError& error)> fault;  ///< it listens again after a second
};

/// Listens to a UDP port in a thread of its own while it lives. That nobody sends is no fault:
/// other than a device, other stations come and go.
class DatagramListener {
 public:
  /// `source`: the port, and who sends; without a host anybody. Its timeout does not count.
  DatagramListener(const DeviceAddress& source, DatagramHandlers handlers);
  ~DatagramListener();
  DatagramListener(const DatagramListener&) = delete;
  DatagramListener& operator=(const DatagramListener&) = delete;

 private:
  void run();
  /// Until something is wrong (DeviceError) or it is to stop (DeviceStopped).
  void listen();

  DeviceAddress source_;
  DatagramHandlers handlers_;
  std::mutex mutex_;
  std::condition_variable stopped_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace datmo
