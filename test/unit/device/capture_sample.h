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

/// An Ethernet frame with an IPv4 datagram, as it is on the wire.
std::string ethernetFrame(const CapturedDatagram& datagram);

/// A capture file (pcap) with these Ethernet frames; `link`: link type in its header.
void writeCapture(const std::string& file, const std::vector<CapturedDatagram>& datagrams,
                  std::uint32_t link = 1);

}  // namespace datmo::samples
