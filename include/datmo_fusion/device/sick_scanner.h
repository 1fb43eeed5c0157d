// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "datmo_fusion/device/cola.h"
#include "datmo_fusion/device/connection.h"
#include "datmo_fusion/device/device.h"

namespace datmo {

/// A scanner of SICK's on Ethernet (LMS1xx, LMS5xx, TiM5xx, TiM7xx), by CoLa A.
///
/// A scan says when it began and when it was sent, both by the scanner's clock: it arrives at the
/// latter, and its stamp is the former.
class SickScanner : public Device {
 public:
  static constexpr int kPort = 2111;

  SickScanner(DeviceAddress address, const DeviceHost& host);

  std::string connect() override;
  DeviceMeasurement next() override;

 private:
  /// The answer to a command, which begins by `expected`. Scans that still come are passed over.
  /// Throws DeviceError (`device_fault`) for another one, an error's (sFA) among them.
  std::string ask(const std::string& command, const std::string& expected);
  std::string nextTelegram();
  /// Silence is no fault as long as the scanner says that it is not measuring yet, which an LMS1xx
  /// takes a while for after it was switched on.
  std::string nextTelegramOnceWarm();
  /// Asks the scanner for its state; false also for one that does not know the question.
  bool isWarmingUp();
  void warnOf(SickState state) const;

  DeviceAddress address_;
  DeviceHost host_;
  std::unique_ptr<Connection> connection_;
  ColaReader reader_;
  SickModel model_;
  std::uint16_t last_counter_ = 0;
};

}  // namespace datmo
