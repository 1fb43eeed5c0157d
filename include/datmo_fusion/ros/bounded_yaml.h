// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include <yaml-cpp/yaml.h>

namespace datmo {

/// Thrown for yaml that cannot be parsed; the message is for the author of the file.
class YamlError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Parses yaml from an untrusted source; `name` is used in messages. Input that is nested deeper,
/// or expands to more through aliases, than any description of sensors, scenes or maps is rejected
/// before it takes memory. So is a recursive alias: walking the result always terminates. Throws
/// YamlError.
YAML::Node parseYaml(const std::string& name, const std::string& text);

/// Parses a file. Throws YamlError that names the file and, if known, the line.
YAML::Node loadYamlFile(const std::string& file);

}  // namespace datmo
