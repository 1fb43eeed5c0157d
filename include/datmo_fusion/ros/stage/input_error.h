// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace datmo {

/// A message that cannot be served: dropped and counted by its reason.
class InputError : public std::runtime_error {
 public:
  /// `reason`: a short, fixed name that is counted (`wrong_size`); `message`: what is wrong, its
  /// value, what was expected.
  InputError(std::string reason, const std::string& message)
      : std::runtime_error(message), reason_(std::move(reason)) {}

  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

}  // namespace datmo
