// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace datmo {

/// A fault of a device: thrown, it ends the connection; passed to DeviceHost::warn, it does not.
class DeviceError : public std::runtime_error {
 public:
  /// `reason`: a short, fixed name that is counted (`silent_device`); `message`: what is wrong, its
  /// value, what is expected.
  DeviceError(std::string reason, const std::string& message)
      : std::runtime_error(message), reason_(std::move(reason)) {}

  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

/// The end of a recording: there is nothing to reconnect to.
class RecordingEnd : public DeviceError {
 public:
  explicit RecordingEnd(const std::string& message) : DeviceError("recording_end", message) {}
};

/// Thrown to end waiting when a device is stopped: not an error.
struct DeviceStopped {};

/// Returns arbitrary bytes in printable form, in quotes: the first 40.
std::string shownBytes(std::string_view bytes);

}  // namespace datmo
