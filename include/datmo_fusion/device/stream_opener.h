// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>

#include "datmo_fusion/device/connection.h"

namespace datmo {

/// Returns whether an address is the file of a serial port: it begins with a slash.
bool isSerial(const DeviceAddress& address);

/// Opens a device at a serial port or on the network. `baud`: of a serial port; `commands`: whether
/// anything is sent to it. Throws DeviceError (`no_connection`), DeviceStopped.
std::unique_ptr<CommandStream> openStream(const DeviceAddress& address, int baud, bool commands,
                                          const std::atomic<bool>& stop);

}  // namespace datmo
