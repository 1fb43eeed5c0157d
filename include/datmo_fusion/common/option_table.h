// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "datmo_fusion/common/options.h"

namespace datmo {

namespace detail {
/// The options of one tier, or all; empty if there are none.
std::string tableOf(const OptionWalk& visit, std::optional<bool> is_public);

template <typename Options>
std::string tableOf(std::optional<bool> is_public) {
  Options defaults;
  return tableOf([&defaults](OptionVisitor& visitor) { defaults.visit(visitor); }, is_public);
}
}  // namespace detail

/// All options of a stage as a Markdown table: key, unit, default, range, description, and whether
/// it may be changed live. Empty if there are none.
template <typename Options>
std::string optionTable() {
  return detail::tableOf<Options>(std::nullopt);
}

/// Those that a user with another sensor, vehicle or city turns.
template <typename Options>
std::string publicOptionTable() {
  return detail::tableOf<Options>(true);
}

/// All others.
template <typename Options>
std::string expertOptionTable() {
  return detail::tableOf<Options>(false);
}

}  // namespace datmo
