// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "datmo_fusion/device/packet_source.h"
#include "datmo_fusion/device/playback_clock.h"

struct pcap;

namespace datmo {

/// The datagrams to a UDP port in a recording of the network (pcap, pcapng: tcpdump, Wireshark),
/// played at the rate at which they were received, or as fast as they can be read if that is
/// slower.
class CaptureFile : public PacketSource {
 public:
  /// `stop`: true ends all waiting; must outlive the file. Throws DeviceError (`bad_recording`).
  CaptureFile(std::string file, int port, const std::atomic<bool>& stop);
  ~CaptureFile() override;
  CaptureFile(const CaptureFile&) = delete;
  CaptureFile& operator=(const CaptureFile&) = delete;

  /// Throws RecordingEnd, DeviceError (`bad_recording`), DeviceStopped.
  std::string_view next() override;

 private:
  std::string file_;
  int port_;
  const std::atomic<bool>& stop_;
  std::unique_ptr<pcap, void (*)(pcap*)> capture_;
  PlaybackClock pace_;
};

/// Returns the data of a network frame if it is a complete UDP datagram (IPv4) to the port; none
/// otherwise. `link`: link type of the capture file (DLT_…).
std::optional<std::string_view> datagramOf(std::string_view frame, int link, int port);

}  // namespace datmo
