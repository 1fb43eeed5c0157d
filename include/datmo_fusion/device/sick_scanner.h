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

/// A scanner of SICK's on Ethernet (LMS1xx, LMS5xx, TiM5xx, TiM7xx), in the dialect of CoLa that it
/// answers in. Each dialect is tried on a connection of its own.
///
/// A scan says when it began and when it was sent, both by the scanner's clock: it arrives at the
/// latter, and its stamp is the former.
class SickScanner : public Device {
 public:
  static constexpr int kPort = 2111;

  /// `dialect`: the one to try first; becomes the one that the scanner speaks. Shared by successive
  /// connections, so that only the first one may have to wait for the timeout.
  SickScanner(DeviceAddress address, std::shared_ptr<ColaDialect> dialect, const DeviceHost& host);

  std::string connect() override;
  DeviceMeasurement next() override;

 private:
  /// Finds out the dialect and the model. Throws DeviceError, DeviceStopped.
  void identify();
  void identifyIn(ColaDialect dialect);
  void send(std::string_view command, const std::vector<ColaParameter>& parameters = {});
  /// The answer to a command, which is called `expected`. Scans that still arrive are passed over.
  /// Throws DeviceError (`device_fault`) for another one, an error (sFA) among them.
  ColaTelegram ask(std::string_view command, std::string_view expected,
                   const std::vector<ColaParameter>& parameters = {});
  /// The same, for an answer that begins with this number of one byte, or it is a `device_fault`.
  void command(std::string_view command, std::string_view expected, std::uint32_t result,
               const std::vector<ColaParameter>& parameters = {});
  ColaTelegram nextTelegram();
  /// Silence is no fault as long as the scanner says that it is not measuring yet, which an LMS1xx
  /// takes a while for after it was switched on.
  ColaTelegram nextTelegramOnceWarm();
  /// Asks the scanner for its state; false also for one that does not know the question.
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
