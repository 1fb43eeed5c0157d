// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/capture_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include <pcap/pcap.h>

#include "datmo_fusion/device/device_error.h"

namespace datmo {

namespace {

DeviceError badRecording(const std::string& file, const std::string& cause) {
  return {"bad_recording",
          file + " cannot be played (" + cause + "): expected a recording of tcpdump or Wireshark"};
}

pcap* openCapture(const std::string& file) {
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  pcap* const capture = pcap_open_offline(file.c_str(), error.data());
  if (capture == nullptr) {
    throw badRecording(file, error.data());
  }
  return capture;
}

/// Reads two bytes in network order; the caller has checked the length.
unsigned wordAt(std::string_view bytes, std::size_t at) {
  constexpr unsigned kByte = 8;
  return static_cast<unsigned>(static_cast<unsigned char>(bytes[at])) << kByte |
         static_cast<unsigned char>(bytes[at + 1]);
}

/// A kind of frame: offsets of its EtherType and its payload.
struct LinkHeader {
  int link;  ///< DLT_...
  std::size_t type;
  std::size_t size;
};
/// IEEE 802.3; LINKTYPE_LINUX_SLL and LINKTYPE_LINUX_SLL2 of tcpdump.org, which `tcpdump -i any`
/// writes.
constexpr std::array<LinkHeader, 3> kLinkHeaders = {
    {{DLT_EN10MB, 12, 14}, {DLT_LINUX_SLL, 14, 16}, {DLT_LINUX_SLL2, 0, 20}}};

const LinkHeader* headerOf(int link) {
  const auto* const found =
      std::find_if(kLinkHeaders.begin(), kLinkHeaders.end(),
                   [link](const LinkHeader& header) { return header.link == link; });
  return found == kLinkHeaders.end() ? nullptr : found;
}

/// Returns where a frame's IPv4 packet begins; past its end if it has none.
std::size_t packetStart(std::string_view frame, int link) {
  constexpr unsigned kIpv4 = 0x0800;
  constexpr unsigned kTagged = 0x8100;  // 802.1Q
  constexpr std::size_t kTag = 4;
  const LinkHeader* const header = headerOf(link);
  if (header == nullptr) {
    return link == DLT_RAW ? 0 : frame.size();
  }
  std::size_t type = header->type;
  std::size_t start = header->size;
  while (type + 2 <= frame.size() && wordAt(frame, type) == kTagged) {
    type = start + kTag - 2;
    start += kTag;
  }
  return type + 2 <= frame.size() && wordAt(frame, type) == kIpv4 ? start : frame.size();
}

}  // namespace

std::optional<std::string_view> datagramOf(std::string_view frame, int link, int port) {
  constexpr std::size_t kIpHeader = 20;
  constexpr std::size_t kUdpHeader = 8;
  constexpr unsigned kWords = 4;  // bytes, unit of the header's length
  constexpr unsigned kUdp = 17;
  constexpr unsigned kFragment = 0x3FFF;  // more fragments follow, or an offset
  const std::string_view packet = frame.substr(std::min(packetStart(frame, link), frame.size()));
  if (packet.size() < kIpHeader + kUdpHeader) {
    return std::nullopt;
  }
  const auto first = static_cast<unsigned char>(packet[0]);
  const std::size_t header = (first & 0x0FU) * kWords;
  if (first >> 4U != 4 || header < kIpHeader || (wordAt(packet, 6) & kFragment) != 0 ||
      static_cast<unsigned char>(packet[9]) != kUdp || packet.size() < header + kUdpHeader) {
    return std::nullopt;
  }
  const std::string_view datagram = packet.substr(header);
  const std::size_t length = wordAt(datagram, 4);
  if (wordAt(datagram, 2) != static_cast<unsigned>(port) || length < kUdpHeader ||
      length > datagram.size()) {
    return std::nullopt;
  }
  return datagram.substr(kUdpHeader, length - kUdpHeader);
}

CaptureFile::CaptureFile(std::string file, int port, const std::atomic<bool>& stop)
    : file_(std::move(file)),
      port_(port),
      stop_(stop),
      capture_(openCapture(file_), &pcap_close),
      pace_(stop) {
  const int link = pcap_datalink(capture_.get());
  if (link != DLT_RAW && headerOf(link) == nullptr) {
    const char* const name = pcap_datalink_val_to_name(link);
    throw badRecording(file_, "its frames are of link type " +
                                  (name == nullptr ? std::to_string(link) : std::string(name)) +
                                  ", not Ethernet, Linux cooked or raw IP");
  }
}

CaptureFile::~CaptureFile() = default;

std::string_view CaptureFile::next() {
  constexpr double kMicrosecond = 1e-6;  // s
  while (true) {
    pcap_pkthdr* header = nullptr;
    const u_char* bytes = nullptr;
    const int result = pcap_next_ex(capture_.get(), &header, &bytes);
    if (result == PCAP_ERROR_BREAK) {
      throw RecordingEnd(file_ + " was played to its end");
    }
    if (result != 1) {
      throw badRecording(file_, pcap_geterr(capture_.get()));
    }
    const std::string_view frame(reinterpret_cast<const char*>(bytes), header->caplen);
    if (const auto data = datagramOf(frame, pcap_datalink(capture_.get()), port_)) {
      pace_.waitUntil(static_cast<double>(header->ts.tv_sec) +
                      static_cast<double>(header->ts.tv_usec) * kMicrosecond);
      return *data;
    }
    if (stop_) {
      throw DeviceStopped();
    }
  }
}

}  // namespace datmo
