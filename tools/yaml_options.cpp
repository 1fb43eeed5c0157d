// SPDX-License-Identifier: BSD-3-Clause
#include "yaml_options.h"

#include <set>

#include "datmo_fusion/ros/bounded_yaml.h"

namespace datmo {

namespace {

/// yaml-cpp's mark of a plain scalar; quoted text has the tag "!".
const char* const kPlainTag = "?";

std::vector<double> numbersIn(const std::string& key, const YAML::Node& list) {
  std::vector<double> numbers;
  for (const YAML::Node& node : list) {
    double number = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, number)) {
      throw OptionError(key +
                        " has an entry that is not a number: expected only numbers in a list");
    }
    numbers.push_back(number);
  }
  return numbers;
}

void flatten(const std::string& prefix, const YAML::Node& section, OptionValues& values) {
  for (const auto& entry : section) {
    const std::string key = prefix + keyOf(entry.first);
    if (entry.second.IsMap()) {
      flatten(key + "/", entry.second, values);
    } else if (!values.emplace(key, optionValue(key, entry.second)).second) {
      throw OptionError(key + " is given twice: expected once");
    }
  }
}

/// yaml-cpp keeps all duplicates of a key, and returns the first.
void checkKeysOnce(const std::string& file, const YAML::Node& node) {
  std::set<std::string> names;
  for (const auto& entry : node) {
    if (!node.IsMap()) {
      checkKeysOnce(file, entry);
      continue;
    }
    const YAML::Node& key = entry.first;
    if (key.IsScalar() && !names.insert(key.Scalar()).second) {
      throw OptionError(file + ":" + std::to_string(key.Mark().line + 1) + ": " + key.Scalar() +
                        " is given twice: expected once");
    }
    checkKeysOnce(file, entry.second);
  }
}

}  // namespace

YAML::Node loadYaml(const std::string& file) {
  try {
    const YAML::Node root = loadYamlFile(file);
    checkKeysOnce(file, root);
    return root;
  } catch (const YamlError& error) {
    throw OptionError(error.what());
  }
}

std::string keyOf(const YAML::Node& node) {
  if (!node.IsScalar()) {
    throw OptionError("a key in line " + std::to_string(node.Mark().line + 1) +
                      " is not plain text: expected a name");
  }
  return node.Scalar();
}

OptionValue optionValue(const std::string& key, const YAML::Node& node) {
  if (node.IsSequence()) {
    return numbersIn(key, node);
  }
  if (!node.IsScalar()) {
    throw OptionError(key + " is empty: expected a value");
  }
  bool toggle = false;
  int whole = 0;
  double number = 0.0;
  if (node.Tag() != kPlainTag) {
    return node.Scalar();
  }
  if (YAML::convert<bool>::decode(node, toggle)) {
    return toggle;
  }
  if (YAML::convert<int>::decode(node, whole)) {
    return whole;
  }
  if (YAML::convert<double>::decode(node, number)) {
    return number;
  }
  return node.Scalar();
}

OptionValues optionValues(const YAML::Node& section) {
  OptionValues values;
  if (!section.IsDefined() || section.IsNull()) {
    return values;
  }
  if (!section.IsMap()) {
    throw OptionError("a section of options is a " +
                      std::string(section.IsSequence() ? "list" : "single value") +
                      ": expected keys with values");
  }
  flatten("", section, values);
  return values;
}

OptionValue parseOptionValue(const std::string& key, const std::string& text) {
  try {
    return optionValue(key, parseYaml(key + " = " + text, text));
  } catch (const YamlError& error) {
    throw OptionError(error.what());
  }
}

void setOption(const std::string& assignment, OptionValues& values) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw OptionError("--set " + assignment + ": expected key=value");
  }
  const std::string key = assignment.substr(0, equals);
  values[key] = parseOptionValue(key, assignment.substr(equals + 1));
}

}  // namespace datmo
