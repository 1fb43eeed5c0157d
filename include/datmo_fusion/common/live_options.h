// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// An option that may be changed while its stage runs, as shown in a user interface.
struct LiveOption {
  std::string key;  ///< full key
  std::string description;
  OptionValue value;                 ///< current value; also defines the type
  Bounds bounds;                     ///< of a number
  std::vector<std::string> choices;  ///< for text; empty: any
};

namespace detail {
std::vector<LiveOption> liveOptionsOf(const OptionWalk& visit);
/// Throws OptionError for a key that is not live.
void setLive(const OptionValues& values, const OptionWalk& visit);
}  // namespace detail

/// Returns the options of Tier::kLive with their current values.
template <typename Options>
std::vector<LiveOption> liveOptions(const Options& options) {
  Options copy = options;
  return detail::liveOptionsOf([&copy](OptionVisitor& visitor) { copy.visit(visitor); });
}

/// Returns the options with some of the live ones changed. Throws OptionError for a key that is not
/// live, and for a value that readOptions rejects.
template <typename Options>
Options withLiveValues(Options options, const OptionValues& values) {
  detail::setLive(values, [&options](OptionVisitor& visitor) { options.visit(visitor); });
  checkOptions(options);
  return options;
}

}  // namespace datmo
