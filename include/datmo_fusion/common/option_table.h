// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/options.h"

namespace datmo {

namespace detail {
std::string tableOf(const OptionWalk& visit);
}

/// All options of a stage as a Markdown table: key, unit, default, range, description.
template <typename Options>
std::string optionTable() {
  Options defaults;
  return detail::tableOf([&defaults](OptionVisitor& visitor) { defaults.visit(visitor); });
}

}  // namespace datmo
