// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/device/device.h"

namespace datmo {

struct DeviceRunnerOptions {
  double min_backoff = 0.1;  ///< s
  double max_backoff = 5.0;  ///< s
  ClockOptions clock;

  void visit(OptionVisitor& visitor);
};

/// Callbacks for the events of a device, all called from the runner's thread.
struct DeviceHandlers {
  std::function<void(const std::string& device)> connected;
  std::function<void(DeviceMeasurement measurement, const ClockState& clock)> measured;
  std::function<void(const DeviceError& error)> fault;    ///< which ended the connection
  std::function<void(const DeviceError& error)> warning;  ///< which did not
  std::function<Stamp()> now;                             ///< the computer's time, for arrivals
};

using DeviceMaker = std::function<std::unique_ptr<Device>(const DeviceHost& host)>;

/// Serves a device in a thread of its own during its lifetime. After any fault it reconnects, first
/// at once and then after increasing pauses, up to `max_backoff`; not after the end of a recording.
class DeviceRunner {
 public:
  /// `make`: creates a new connection each time. Throws OptionError.
  DeviceRunner(const Checked<DeviceRunnerOptions>& options, DeviceMaker make,
               DeviceHandlers handlers);
  ~DeviceRunner();
  DeviceRunner(const DeviceRunner&) = delete;
  DeviceRunner& operator=(const DeviceRunner&) = delete;

 private:
  void run();
  /// Serves one connection, until a fault (DeviceError) or a request to stop (DeviceStopped).
  void serve();
  void waitBeforeNext();

  DeviceRunnerOptions options_;
  DeviceMaker make_;
  DeviceHandlers handlers_;
  DeviceClock clock_;
  double backoff_ = 0.0;  ///< s
  std::mutex mutex_;
  std::condition_variable stopped_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace datmo
