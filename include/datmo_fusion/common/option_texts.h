// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "datmo_fusion/common/options.h"

namespace datmo {

namespace detail {
std::vector<std::pair<std::string, OptionValue>> valuesOf(const OptionWalk& visit);
}  // namespace detail

/// Returns the values of all options as in a yaml file, by full key.
template <typename Options>
std::map<std::string, std::string> optionTexts(Options options) {
  std::map<std::string, std::string> texts;
  for (const auto& [key, value] :
       detail::valuesOf([&options](OptionVisitor& visitor) { options.visit(visitor); })) {
    texts[key] = toText(value);
  }
  return texts;
}

}  // namespace datmo
