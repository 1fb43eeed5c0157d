// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <netinet/in.h>

namespace datmo {

/// Of a name or address, by the system's look-up. Throws DeviceError (`no_connection`).
sockaddr_in ipv4Address(const std::string& host, int port);

}  // namespace datmo
