// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"

namespace datmo {

namespace detail {
std::vector<std::string> keysOf(const OptionWalk& visit);
}  // namespace detail

/// Returns the full keys of all options, in the order of declaration.
template <typename Options>
std::vector<std::string> optionKeys() {
  Options defaults;
  return detail::keysOf([&defaults](OptionVisitor& visitor) { defaults.visit(visitor); });
}

}  // namespace datmo
