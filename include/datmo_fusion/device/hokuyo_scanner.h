// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/device/connection.h"
#include "datmo_fusion/device/device.h"
#include "datmo_fusion/device/scip.h"

namespace datmo {

struct HokuyoOptions {
  int baud = 115200;  ///< bits per second

  void visit(OptionVisitor& visitor);
};

/// A Hokuyo scanner on Ethernet (UST, UTM-30LX-EW, ...), or at a serial port, as which USB scanners
/// appear (URG-04LX, UTM-30LX, ...), by SCIP 2.0.
///
/// A scan arrives when it is complete: its stamp is the device's time on the computer's clock,
/// minus the time from the first beam to the last; it is late by the minimum network delay of a
/// scan.
class HokuyoScanner : public Device {
 public:
  static constexpr int kPort = 10940;

  HokuyoScanner(DeviceAddress address, const HokuyoOptions& options, const DeviceHost& host);

  std::string connect() override;
  DeviceMeasurement next() override;

 private:
  /// Returns the answer to a command. Data that a scanner still sends because it was not stopped
  /// are skipped.
  ScipAnswer ask(const std::string& command);
  ScipAnswer nextAnswer();
  /// Resets the scanner: at a serial port it does not notice that an earlier client has left. It
  /// may be in the middle of a scan, and old firmware starts with SCIP 1.1.
  void beginAtSerialPort();

  DeviceAddress address_;
  HokuyoOptions options_;
  DeviceHost host_;
  std::unique_ptr<CommandStream> connection_;
  ScipReader reader_;
  ScipModel model_;
};

}  // namespace datmo
