// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// An option that may be changed while its stage runs, as a user interface shows it.
struct LiveOption {
  std::string key;  ///< complete
  std::string description;
  OptionValue value;                 ///< the present one; it says the type
  Bounds bounds;                     ///< of numbers
  std::vector<std::string> choices;  ///< of text; empty: any
};

namespace detail {
std::vector<LiveOption> liveOptionsOf(const OptionWalk& visit);
/// Throws OptionError for a key that is not live.
void setLive(const OptionValues& values, const OptionWalk& visit);
}  // namespace detail

/// The options of Tier::kLive, with their present values.
template <typename Options>
std::vector<LiveOption> liveOptions(const Options& options) {
  Options copy = options;
  return detail::liveOptionsOf([&copy](OptionVisitor& visitor) { copy.visit(visitor); });
}

/// The options with some of the live ones changed. Throws OptionError for a key that is not live,
/// and for a value that readOptions refuses.
template <typename Options>
Options withLiveValues(Options options, const OptionValues& values) {
  detail::setLive(values, [&options](OptionVisitor& visitor) { options.visit(visitor); });
  checkOptions(options);
  return options;
}

}  // namespace datmo
