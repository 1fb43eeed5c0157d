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

/// A scanner of Hokuyo's on Ethernet (UST, UTM-30LX-EW, ...), or at a serial port, as which one on
/// USB appears (URG-04LX, UTM-30LX, ...), by SCIP 2.0.
///
/// A scan arrives when all of it is measured: its stamp is the device's time on the computer's
/// clock, minus the time from the first beam to the last; it is late by the shortest time that a
/// scan takes through the network.
class HokuyoScanner : public Device {
 public:
  static constexpr int kPort = 10940;

  HokuyoScanner(DeviceAddress address, const HokuyoOptions& options, const DeviceHost& host);

  std::string connect() override;
  DeviceMeasurement next() override;

 private:
  /// The answer to a command. What a scanner still sends that was not told to stop is passed over.
  ScipAnswer ask(const std::string& command);
  ScipAnswer nextAnswer();
  /// At a serial port nobody tells the scanner that the one who asked before has gone: it may be
  /// in the middle of a scan, and old firmware begins by SCIP 1.1.
  void beginAtSerialPort();

  DeviceAddress address_;
  HokuyoOptions options_;
  DeviceHost host_;
  std::unique_ptr<CommandStream> connection_;
  ScipReader reader_;
  ScipModel model_;
};

}  // namespace datmo
