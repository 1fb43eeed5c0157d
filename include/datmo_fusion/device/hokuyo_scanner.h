// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/device/clock_estimator.h"
#include "datmo_fusion/device/connection.h"
#include "datmo_fusion/device/device_error.h"
#include "datmo_fusion/device/scip.h"

namespace datmo {

struct HokuyoOptions {
  std::string address = "192.168.0.10";
  int port = 10940;
  double timeout = 1.0;      ///< s
  double min_backoff = 0.1;  ///< s
  double max_backoff = 5.0;  ///< s
  ClockOptions clock;

  void visit(OptionVisitor& visitor);
};

/// One scan of a device.
struct DeviceScan {
  Stamp stamp;  ///< of the first beam
  std::vector<float> ranges;
  std::uint64_t missed = 0;   ///< scans between the last one and this
  double clock_offset = 0.0;  ///< s, the computer's time minus the device's
  double clock_drift = 0.0;   ///< s/s
  std::uint64_t clock_steps = 0;
};

/// What a device tells, each from its own thread.
struct DeviceHandlers {
  std::function<void(const ScipModel& model)> connected;
  std::function<void(const ScipModel& model, DeviceScan scan)> scan;
  std::function<void(const DeviceError& error)> fault;
  std::function<Stamp()> now;  ///< the computer's time, for arrivals
};

/// A scanner of Hokuyo's on Ethernet (UST, UTM-30LX-EW, ...), by SCIP 2.0, in a thread of its own
/// while it lives. Whatever goes wrong, it connects again, first at once and then more and more
/// seldom, up to `max_backoff`.
///
/// A scan arrives when all of it is measured: its stamp is the device's time on the computer's
/// clock (ClockEstimator), minus the time from the first beam to the last; it is late by the
/// shortest time that a scan takes through the network.
class HokuyoScanner {
 public:
  /// Throws OptionError.
  HokuyoScanner(const Checked<HokuyoOptions>& options, DeviceHandlers handlers);
  ~HokuyoScanner();
  HokuyoScanner(const HokuyoScanner&) = delete;
  HokuyoScanner& operator=(const HokuyoScanner&) = delete;

 private:
  void run();
  /// One connection, until something is wrong (DeviceError) or it is to stop.
  void serve();
  /// The answer to a command. What a scanner still sends that was not told to stop is passed over.
  ScipAnswer ask(const Connection& connection, const std::string& command);
  ScipAnswer nextAnswer(const Connection& connection);
  void take(const ScipModel& model, const ScipAnswer& answer);
  double clockSeconds(std::uint32_t clock);
  void waitBeforeNext();

  HokuyoOptions options_;
  DeviceHandlers handlers_;
  ScipReader reader_;
  ClockEstimator clock_;
  std::uint64_t ticks_ = 0;       ///< ms of the device's clock since it was connected
  std::uint32_t last_clock_ = 0;  ///< as it comes
  bool has_scan_ = false;         ///< of this connection
  double backoff_ = 0.0;          ///< s
  std::mutex mutex_;
  std::condition_variable stopped_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace datmo
