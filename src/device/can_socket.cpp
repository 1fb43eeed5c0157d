// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/can_socket.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "can_number.h"
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "datmo_fusion/device/waiting.h"

namespace datmo {

namespace {

constexpr int kSwitchOn = 1;

DeviceError noInterface(const std::string& interface, int error) {
  return {"no_connection", "the CAN interface " + interface + " cannot be opened (" +
                               std::strerror(error) +
                               "): expected one that `ip link show type can` lists"};
}

DeviceError interfaceDown(const std::string& interface) {
  return {"interface_down", "the CAN interface " + interface +
                                " is down: expected it to be up; `ip link set " + interface +
                                " up type can bitrate 500000`, with the bus's own bit rate"};
}

/// Returns whether an interface, which must exist, is up.
bool isUp(int descriptor, const std::string& interface) {
  ifreq request{};
  interface.copy(request.ifr_name, IFNAMSIZ - 1);
  const auto flags = [&request] { return static_cast<unsigned>(request.ifr_flags); };
  return ioctl(descriptor, SIOCGIFFLAGS, &request) == 0 && (flags() & IFF_UP) != 0;
}

void bindTo(int descriptor, const std::string& interface) {
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(if_nametoindex(interface.c_str()));
  if (address.can_ifindex == 0 ||
      bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw noInterface(interface, errno);
  }
  if (!isUp(descriptor, interface)) {
    throw interfaceDown(interface);
  }
  constexpr can_err_mask_t kAllErrors = CAN_ERR_MASK;
  setsockopt(descriptor, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &kAllErrors, sizeof kAllErrors);
  setsockopt(descriptor, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &kSwitchOn, sizeof kSwitchOn);
}

/// Returns the time since the kernel received a frame, s; 0 if that is unknown, or the clock has
/// been set since then.
double ageOf(const timeval& received) {
  constexpr double kMicrosecond = 1e-6;  // s
  constexpr double kOld = 10.0;          // s; older than any frame that waits in a socket
  timeval now{};
  gettimeofday(&now, nullptr);
  const double age = static_cast<double>(now.tv_sec - received.tv_sec) +
                     kMicrosecond * static_cast<double>(now.tv_usec - received.tv_usec);
  return age > 0.0 && age < kOld ? age : 0.0;
}

/// Converts a frame of the kernel; both kinds have the same first fields.
CanFrame frameOf(const canfd_frame& read, std::size_t size) {
  const bool is_classic = size == CAN_MTU;
  const bool has_size = is_classic || size == CANFD_MTU;
  if (!has_size || read.len > (is_classic ? CAN_MAX_DLEN : CANFD_MAX_DLEN)) {
    throw CanFrameError("a frame with " + std::to_string(size) + " bytes indicates " +
                        std::to_string(read.len) + " of data: expected a frame of CAN or CAN FD");
  }
  CanFrame frame;
  setNumber(read.can_id, (read.can_id & CAN_EFF_FLAG) != 0, frame);
  frame.size = (read.can_id & CAN_RTR_FLAG) != 0 ? 0 : read.len;
  std::copy_n(read.data, frame.size, frame.data.begin());
  return frame;
}

}  // namespace

std::unique_ptr<CanSocket> CanSocket::open(const std::string& interface, double timeout,
                                           const std::atomic<bool>& stop) {
  const int descriptor = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (descriptor < 0) {
    throw noInterface(interface, errno);
  }
  auto opened = std::make_unique<CanSocket>(descriptor, interface, timeout, stop);
  bindTo(descriptor, interface);
  return opened;
}

CanSocket::CanSocket(int descriptor, std::string name, double timeout,
                     const std::atomic<bool>& stop)
    : socket_(descriptor), name_(std::move(name)), timeout_(timeout), stop_(stop) {
  setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMP, &kSwitchOn, sizeof kSwitchOn);
  setsockopt(socket_, SOL_SOCKET, SO_RXQ_OVFL, &kSwitchOn, sizeof kSwitchOn);
}

CanSocket::~CanSocket() { close(socket_); }

CanFrame CanSocket::next() {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(timeout_);
  do {
    CanFrame frame;
    if (read(frame)) {
      return frame;
    }
    const std::chrono::duration<double> left = end - Clock::now();
    waitForEvents(socket_, POLLIN, left.count(), stop_);
    if (stop_) {
      throw DeviceStopped();
    }
  } while (Clock::now() < end);
  throw DeviceError("silent_device",
                    "no frame on " + name_ + " for " + std::to_string(timeout_) +
                        " s: is the ignition on, and is the bit rate that of the bus?");
}

bool CanSocket::read(CanFrame& frame) {
  canfd_frame bytes{};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timeval)) + CMSG_SPACE(sizeof(overflow_))>
      control{};
  iovec part{&bytes, sizeof bytes};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t size = recvmsg(socket_, &message, MSG_DONTWAIT);
  if (size < 0) {
    if (errno == EAGAIN || errno == EINTR) {
      return false;
    }
    if (errno == ENETDOWN) {
      throw interfaceDown(name_);
    }
    throw DeviceError("lost_connection", "the CAN interface " + name_ + " fails (" +
                                             std::strerror(errno) + "): reopening it");
  }
  frame = frameOf(bytes, static_cast<std::size_t>(size));
  for (cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr;
       header = CMSG_NXTHDR(&message, header)) {
    if (header->cmsg_level != SOL_SOCKET) {
      continue;
    }
    if (header->cmsg_type == SO_TIMESTAMP) {
      timeval received{};
      std::memcpy(&received, CMSG_DATA(header), sizeof received);
      frame.age = ageOf(received);
    } else if (header->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t overflow = 0;
      std::memcpy(&overflow, CMSG_DATA(header), sizeof overflow);
      frame.lost = overflow - std::exchange(overflow_, overflow);
    }
  }
  return true;
}

}  // namespace datmo
