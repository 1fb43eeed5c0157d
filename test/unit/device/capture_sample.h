// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace datmo::samples {

struct CapturedDatagram {
  double time = 0.0;  ///< s
  int port = 2368;    ///< that it goes to
  std::string data;
};

/// A frame of Ethernet with an IPv4 datagram, as it is on the wire.
std::string ethernetFrame(const CapturedDatagram& datagram);

/// A capture file (pcap) with these frames of Ethernet; `link`: what it says that they are.
void writeCapture(const std::string& file, const std::vector<CapturedDatagram>& datagrams,
                  std::uint32_t link = 1);

}  // namespace datmo::samples
