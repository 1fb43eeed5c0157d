// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace datmo {

/// Thrown for a station's message that is malformed or of no use to us.
class WireError : public std::runtime_error {
 public:
  /// `reason`: a short, fixed name under which it is counted (`truncated_message`); `message`: what
  /// is wrong, the value, what was expected.
  WireError(std::string reason, const std::string& message)
      : std::runtime_error(message), reason_(std::move(reason)) {}

  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

}  // namespace datmo
