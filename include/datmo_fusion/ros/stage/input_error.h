// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace datmo {

/// Thrown for an unusable message, which is dropped and counted by reason.
class InputError : public std::runtime_error {
 public:
  /// `reason`: a short, fixed name under which it is counted (`wrong_size`); `message`: what is
  /// wrong, the value, what was expected.
  InputError(std::string reason, const std::string& message)
      : std::runtime_error(message), reason_(std::move(reason)) {}

  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

}  // namespace datmo
