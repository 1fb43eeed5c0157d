// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "datmo_fusion/device/device_setup.h"

namespace datmo::samples {

/// Waits for events from another thread.
template <typename Item>
class Mailbox {
 public:
  void put(Item item) {
    const std::lock_guard<std::mutex> lock(mutex_);
    items_.push_back(std::move(item));
    arrived_.notify_all();
  }

  bool isEmpty() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return items_.empty();
  }

  Item take() {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!arrived_.wait_for(lock, std::chrono::minutes(1), [this] { return !items_.empty(); })) {
      throw std::runtime_error("nothing came");
    }
    Item item = std::move(items_.front());
    items_.pop_front();
    return item;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Item> items_;
};

struct Measured {
  Stamp stamp;
  DeviceData data;
  std::uint64_t missed = 0;
  ClockState clock;

  const DeviceScan& scan() const { return std::get<DeviceScan>(data); }
};

/// Serves a device on loopback, and keeps its output.
class DeviceProbe {
 public:
  static constexpr double kStart = 1.7e9;  ///< s, when the computer's time `host` is 0

  explicit DeviceProbe(DeviceKind kind) {
    setup.kind = kind;
    setup.address = "127.0.0.1";
    setup.timeout = 60.0;  // a fake device on a busy machine does not count as silent
    setup.runner.min_backoff = 0.001;
    setup.runner.max_backoff = 0.01;
  }

  void start(int port) {
    setup.port = port;
    DeviceHandlers handlers;
    handlers.connected = [this](const std::string& device) { devices.put(device); };
    handlers.measured = [this](DeviceMeasurement one, const ClockState& clock) {
      measurements.put({one.stamp, std::move(one.data), one.missed, clock});
    };
    handlers.fault = [this](const DeviceError& error) { faults.put(error.reason()); };
    handlers.warning = [this](const DeviceError& error) { warnings.put(error.reason()); };
    handlers.now = [this] { return Stamp::fromSeconds(kStart + host.load()); };
    runner_ = std::make_unique<DeviceRunner>(setup.runner, deviceMaker(setup), handlers);
  }

  /// Waits until the device's thread has ended.
  void stop() { runner_.reset(); }

  DeviceSetup setup;
  std::atomic<double> host{0.0};  ///< s, the computer's time
  Mailbox<std::string> devices;
  Mailbox<Measured> measurements;
  Mailbox<std::string> faults;
  Mailbox<std::string> warnings;

 private:
  std::unique_ptr<DeviceRunner> runner_;
};

}  // namespace datmo::samples
