// SPDX-License-Identifier: BSD-3-Clause
#include "ipv4_address.h"

#include <cstdint>
#include <cstring>

#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>

#include "datmo_fusion/device/device_error.h"

namespace datmo {

sockaddr_in ipv4Address(const std::string& host, int port) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), nullptr, &wanted, &found);
  if (error != 0) {
    throw DeviceError("no_connection", "no device is named " + host + " (" + gai_strerror(error) +
                                           "): expected the name or address of one");
  }
  sockaddr_in address{};
  std::memcpy(&address, found->ai_addr, sizeof address);
  freeaddrinfo(found);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

}  // namespace datmo
