// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <yaml-cpp/yaml.h>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// Parses a yaml file. Throws OptionError that names the file, and the line where it is no yaml or
/// has a key, or a section, that stands there already.
YAML::Node loadYaml(const std::string& file);

/// A key of a map as text. Throws OptionError that names the line if it is a list or a map.
std::string keyOf(const YAML::Node& node);

/// One plain value: true or false, a whole number, a number, or text (always where it is quoted).
/// Throws OptionError unless `node` is a scalar; `key` is named in the message.
OptionValue optionValue(const std::string& key, const YAML::Node& node);

/// All values of a section, flattened: `{map: {cell_size: 0.3}}` is `map/cell_size`. An empty
/// section has none. Throws OptionError for a list, a key without value and a key given twice.
OptionValues optionValues(const YAML::Node& section);

/// Parses `text` as the value of one option, as if it stood in a yaml file. Throws OptionError.
OptionValue parseOptionValue(const std::string& key, const std::string& text);

/// Takes `key=value`, as it stands on a command line, in place of what `values` hold for the key.
/// Throws OptionError.
void setOption(const std::string& assignment, OptionValues& values);

}  // namespace datmo
