// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/device_options.h"

namespace datmo {

void DeviceOptions::visit(OptionVisitor& visitor) {
  visitor.text({"frame", "", "frame of the device's measurements: its own"}, frame, {});
  visitor.group("input", [&] { input.visit(visitor); });
  device.visit(visitor);
}

}  // namespace datmo
