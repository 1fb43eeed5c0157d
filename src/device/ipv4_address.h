// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <netinet/in.h>

namespace datmo {

/// Returns the address of a host name or address, by the system's lookup. Throws DeviceError
/// (`no_connection`).
sockaddr_in ipv4Address(const std::string& host, int port);

}  // namespace datmo
