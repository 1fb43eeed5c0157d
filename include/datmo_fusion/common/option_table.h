// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>
#include <string>

#include "datmo_fusion/common/options.h"

namespace datmo {

namespace detail {
/// Options of one tier, or all, except those with these keys; empty if there are none.
std::string tableOf(const OptionWalk& visit, std::optional<bool> is_public,
                    const std::set<std::string>& left_out);

template <typename Options>
std::string tableOf(std::optional<bool> is_public, const std::set<std::string>& left_out) {
  Options defaults;
  return tableOf([&defaults](OptionVisitor& visitor) { defaults.visit(visitor); }, is_public,
                 left_out);
}
}  // namespace detail

/// Returns all options of a stage as a Markdown table: key, unit, default, range, description, and
/// whether it can be changed live. Empty if there are none.
template <typename Options>
std::string optionTable() {
  return detail::tableOf<Options>(std::nullopt, {});
}

/// Returns the options that users of another sensor, vehicle or city adjust, except `left_out`.
template <typename Options>
std::string publicOptionTable(const std::set<std::string>& left_out = {}) {
  return detail::tableOf<Options>(true, left_out);
}

/// Returns all other options, except `left_out`.
template <typename Options>
std::string expertOptionTable(const std::set<std::string>& left_out = {}) {
  return detail::tableOf<Options>(false, left_out);
}

}  // namespace datmo
