// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/device/can_motion.h"
#include "datmo_fusion/device/device_runner.h"
#include "datmo_fusion/device/hokuyo_scanner.h"
#include "datmo_fusion/device/nmea_receiver.h"
#include "datmo_fusion/device/velodyne_lidar.h"

namespace datmo {

/// The supported protocols.
enum class DeviceKind { kHokuyo, kSickLms, kVelodyne, kNmea, kCan };

/// Kind, address and options of a device.
struct DeviceSetup {
  DeviceKind kind = DeviceKind::kHokuyo;
  std::string address = "192.168.0.10";
  int port = 0;           ///< 0: the default of the kind
  double timeout = 1.0;   ///< s
  std::string recording;  ///< of a lidar's packets or a bus's frames; empty: none
  DeviceRunnerOptions runner;
  HokuyoOptions hokuyo;
  VelodyneOptions velodyne;
  NmeaOptions nmea;
  CanOptions can;

  void visit(OptionVisitor& visitor);

  /// Throws OptionError for a CAN bus whose signals are missing or wrong.
  void check() const;
};

DeviceMaker deviceMaker(const Checked<DeviceSetup>& setup);

}  // namespace datmo
