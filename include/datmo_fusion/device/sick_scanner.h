// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "datmo_fusion/device/cola.h"
#include "datmo_fusion/device/connection.h"
#include "datmo_fusion/device/device.h"
#include "datmo_fusion/device/sick_telegram.h"

namespace datmo {

/// A SICK scanner on Ethernet (LMS1xx, LMS5xx, TiM5xx, TiM7xx), in the dialect of CoLa in which it
/// answers. Each dialect is tried on a connection of its own.
///
/// A scan contains the times when it began and when it was sent, both on the scanner's clock: the
/// latter is compared with its arrival, the former is its stamp.
class SickScanner : public Device {
 public:
  static constexpr int kPort = 2111;

  /// `dialect`: the one to try first; becomes the one that the scanner speaks. Shared by successive
  /// connections, so that only the first one may have to wait for the timeout.
  SickScanner(DeviceAddress address, std::shared_ptr<ColaDialect> dialect, const DeviceHost& host);

  std::string connect() override;
  DeviceMeasurement next() override;

 private:
  /// Determines the dialect and the model. Throws DeviceError, DeviceStopped.
  void identify();
  void identifyIn(ColaDialect dialect);
  void send(std::string_view command, const std::vector<ColaParameter>& parameters = {});
  /// Returns the answer to a command, whose name must be `expected`. Scans that still arrive are
  /// skipped. Throws DeviceError (`device_fault`) for any other answer, including errors (sFA).
  ColaTelegram ask(std::string_view command, std::string_view expected,
                   const std::vector<ColaParameter>& parameters = {});
  /// The same, for an answer that must begin with this number of one byte; otherwise
  /// `device_fault`.
  void command(std::string_view command, std::string_view expected, std::uint32_t result,
               const std::vector<ColaParameter>& parameters = {});
  ColaTelegram nextTelegram();
  /// Returns the next telegram. Silence is not a fault as long as the scanner reports that it is
  /// not measuring yet: an LMS1xx takes a while after it was switched on.
  ColaTelegram nextTelegramOnceWarm();
  /// Asks the scanner for its state; also false for one that does not know the command.
  bool isWarmingUp();
  void warnOf(SickState state) const;

  DeviceAddress address_;
  std::shared_ptr<ColaDialect> dialect_;
  DeviceHost host_;
  std::unique_ptr<Connection> connection_;
  ColaReader reader_;
  SickModel model_;
  std::uint16_t last_counter_ = 0;
};

}  // namespace datmo
