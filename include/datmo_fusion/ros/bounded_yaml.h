// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include <yaml-cpp/yaml.h>

namespace datmo {

/// What is no yaml that can be read, in words for its author.
class YamlError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Parses yaml of any origin, `name` in messages. What is deeper, or with its aliases larger, than
/// any description of sensors, scenes or maps is refused before it takes memory, and so is an alias
/// that stands for what it stands in: who walks through the result ends. Throws YamlError.
YAML::Node parseYaml(const std::string& name, const std::string& text);

/// The same of a file. Throws YamlError that names the file, and the line where there is one.
YAML::Node loadYamlFile(const std::string& file);

}  // namespace datmo
