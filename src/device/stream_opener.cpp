// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/stream_opener.h"

#include "datmo_fusion/device/serial_line.h"

namespace datmo {

bool isSerial(const DeviceAddress& address) { return address.host.rfind('/', 0) == 0; }

std::unique_ptr<CommandStream> openStream(const DeviceAddress& address, int baud, bool commands,
                                          const std::atomic<bool>& stop) {
  if (isSerial(address)) {
    return std::make_unique<SerialLine>(
        SerialSettings{address.host, baud, address.timeout, commands}, stop);
  }
  return std::make_unique<Connection>(address, stop);
}

}  // namespace datmo
