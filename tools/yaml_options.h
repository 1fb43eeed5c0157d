// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <yaml-cpp/yaml.h>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// Parses a yaml file. Throws OptionError that names the file and the line if it is not valid yaml
/// or has a duplicate key or section.
YAML::Node loadYaml(const std::string& file);

/// A key of a map as text. Throws OptionError that names the line if it is a list or a map.
std::string keyOf(const YAML::Node& node);

/// One plain value: a boolean, an integer, a number, or text (always if it is quoted). Throws
/// OptionError unless `node` is a scalar; `key` is named in the message.
OptionValue optionValue(const std::string& key, const YAML::Node& node);

/// All values of a section, flattened: `{map: {cell_size: 0.3}}` is `map/cell_size`. An empty
/// section has none. Throws OptionError for a list, a key without value and a key given twice.
OptionValues optionValues(const YAML::Node& section);

/// Parses `text` as the value of one option, as in a yaml file. Throws OptionError.
OptionValue parseOptionValue(const std::string& key, const std::string& text);

/// Replaces the value of the key in `values` by that of `key=value` from a command line. Throws
/// OptionError.
void setOption(const std::string& assignment, OptionValues& values);

}  // namespace datmo
