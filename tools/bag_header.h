// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

namespace datmo {

/// The header of a record of a bag: fields, each of which is a length, a name, `=` and a value.
class BagHeader {
 public:
  BagHeader() = default;
  explicit BagHeader(std::string bytes) : bytes_(std::move(bytes)) {}

  std::size_t size() const { return bytes_.size(); }

  /// Whether each field has a name, and the last one ends where it ends. rosbag does not check the
  /// latter, and reads a field up to 1 MB past its memory; without a name, it prints an error of
  /// its own before ours.
  bool hasWholeFields() const;

  /// A number; nothing if it is missing.
  template <typename Number>
  std::optional<Number> number(const std::string& name) const {
    const std::optional<std::string> found = value(name);
    if (!found || found->size() != sizeof(Number)) {
      return {};
    }
    Number number = 0;
    std::memcpy(&number, found->data(), sizeof(number));
    return number;
  }

 private:
  /// Of the last field of this name, as in rosbag; nothing if there is none.
  std::optional<std::string> value(const std::string& name) const;

  std::string bytes_;
};

}  // namespace datmo
