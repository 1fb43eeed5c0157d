// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace datmo {

/// What a device did that it should not have done: its connection is given up.
class DeviceError : public std::runtime_error {
 public:
  /// `reason`: a short, fixed name that is counted (`silent_device`); `message`: what is wrong, its
  /// value, what was expected.
  DeviceError(std::string reason, const std::string& message)
      : std::runtime_error(message), reason_(std::move(reason)) {}

  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

/// A recording is at its end: there is nothing to connect with again.
class RecordingEnd : public DeviceError {
 public:
  explicit RecordingEnd(const std::string& message) : DeviceError("recording_end", message) {}
};

/// It is to stop, and waits no more: no error.
struct DeviceStopped {};

/// What can be shown, in quotes, of bytes that may be anything: the first 40.
std::string shownBytes(std::string_view bytes);

}  // namespace datmo
