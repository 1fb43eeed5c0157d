// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "simulator/path.h"
#include "simulator/speed_profile.h"
#include "yaml_options.h"
#include <yaml-cpp/yaml.h>

#include "datmo_fusion/common/options.h"

namespace datmo::simulator {

/// Runs `read` and prepends `location` to the message of its exceptions.
void readAt(const std::string& location, const std::function<void()>& read);

/// Rows of `columns` numbers each. Throws OptionError for anything else.
std::vector<std::vector<double>> readRows(const std::string& key, const YAML::Node& node,
                                          std::size_t columns);

/// `[[x, y], ...]` in m.
Polyline readPoints(const YAML::Node& entry, const std::string& key);

/// `[[time, speed], ...]` in s and m/s under the key `speed`.
SpeedProfile readSpeed(const YAML::Node& entry);

/// Calls `read` for each entry of the list under `key`, if it exists; the location (`roads[0]:
/// ...`) is prepended to its exceptions.
void readList(const YAML::Node& scene, const std::string& key,
              const std::function<void(const YAML::Node&)>& read);

/// Throws OptionError unless `node` is a map whose keys are all in `known`.
void expectKeys(const YAML::Node& node, const std::set<std::string>& known);

/// Reads the single values of an entry; `lists` are the keys that are read separately. Throws
/// OptionError.
template <typename Item>
Item readItem(const YAML::Node& entry, const std::set<std::string>& lists = {}) {
  if (!entry.IsMap()) {
    throw OptionError("expected keys with values");
  }
  YAML::Node values(YAML::NodeType::Map);
  for (const auto& pair : entry) {
    if (lists.count(keyOf(pair.first)) == 0) {
      values.force_insert(pair.first, pair.second);
    }
  }
  return readOptions<Item>(optionValues(values));
}

}  // namespace datmo::simulator
