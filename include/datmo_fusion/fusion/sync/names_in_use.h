// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace datmo {

/// Returns the names of the sources, a map from name to options, whose `use` is set.
template <typename Sources>
std::vector<std::string> namesInUse(const Sources& sources) {
  std::vector<std::string> names;
  for (const auto& [name, source] : sources) {
    if (source.use) {
      names.push_back(name);
    }
  }
  return names;
}

}  // namespace datmo
