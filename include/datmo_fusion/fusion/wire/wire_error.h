// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace datmo {

/// A message of a station that is none, or not one for us.
class WireError : public std::runtime_error {
 public:
  /// `reason`: a short, fixed name that is counted (`truncated_message`); `message`: what is wrong,
  /// its value, what was expected.
  WireError(std::string reason, const std::string& message)
      : std::runtime_error(message), reason_(std::move(reason)) {}

  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

}  // namespace datmo
