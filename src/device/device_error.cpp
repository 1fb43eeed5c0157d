// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/device/device_error.h"

#include <cctype>

namespace datmo {

std::string shownBytes(std::string_view bytes) {
  constexpr std::size_t kShownCharacters = 40;
  std::string text;
  for (const char c : bytes.substr(0, kShownCharacters)) {
    text += std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
  }
  return "'" + text + "'";
}

}  // namespace datmo
