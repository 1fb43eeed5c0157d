// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/device/device_setup.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

/// Options of the nodelet `device`.
struct DeviceOptions {
  std::string frame = "laser";
  StreamOptions input;
  DeviceSetup device;

  void visit(OptionVisitor& visitor);

  /// Throws OptionError.
  void check() const { device.check(); }
};

}  // namespace datmo
