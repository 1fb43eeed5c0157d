// SPDX-License-Identifier: BSD-3-Clause
#include "bag_header.h"

#include <string_view>

namespace datmo {

namespace {

/// Removes the first field from `rest` and returns it without its length; nothing if it is not
/// whole.
std::optional<std::string_view> nextField(std::string_view& rest) {
  std::uint32_t length = 0;
  if (rest.size() < sizeof(length)) {
    return {};
  }
  std::memcpy(&length, rest.data(), sizeof(length));
  rest.remove_prefix(sizeof(length));
  if (length > rest.size()) {
    return {};
  }
  const std::string_view field = rest.substr(0, length);
  rest.remove_prefix(length);
  return field;
}

}  // namespace

bool BagHeader::hasWholeFields() const {
  for (std::string_view rest = bytes_; !rest.empty();) {
    const std::optional<std::string_view> field = nextField(rest);
    if (!field || field->find('=') == std::string_view::npos) {
      return false;
    }
  }
  return true;
}

std::optional<std::string> BagHeader::value(const std::string& name) const {
  std::optional<std::string> found;
  const std::string head = name + "=";
  for (std::string_view rest = bytes_; !rest.empty();) {
    const std::optional<std::string_view> field = nextField(rest);
    if (!field) {
      break;
    }
    if (field->substr(0, head.size()) == head) {
      found = field->substr(head.size());
    }
  }
  return found;
}

}  // namespace datmo
