// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/live_option_conversion.h"

#include <algorithm>
#include <limits>
#include <string>
#include <variant>

namespace datmo {

namespace {

template <typename Parameter, typename Value>
Parameter parameter(const std::string& name, const Value& value) {
  Parameter parameter;
  parameter.name = name;
  parameter.value = value;
  return parameter;
}

/// Adds values to a message.
struct ConfigWriter {
  const std::string& name;
  dynamic_reconfigure::Config& config;

  void operator()(bool value) const {
    config.bools.push_back(parameter<dynamic_reconfigure::BoolParameter>(name, value));
  }
  void operator()(int value) const {
    config.ints.push_back(parameter<dynamic_reconfigure::IntParameter>(name, value));
  }
  void operator()(double value) const {
    config.doubles.push_back(parameter<dynamic_reconfigure::DoubleParameter>(name, value));
  }
  void operator()(const std::string& value) const {
    config.strs.push_back(parameter<dynamic_reconfigure::StrParameter>(name, value));
  }
  /// The protocol has no lists: such an option is omitted.
  void operator()(const std::vector<double>& /*values*/) const {}
};

/// The protocol's type names, in the order of OptionValue.
std::string typeOf(const OptionValue& value) {
  constexpr const char* kTypes[] = {"bool", "int", "double", "str"};
  return kTypes[value.index()];
}

/// A bound in the option's own type; an infinite one becomes the type's limit.
OptionValue boundLike(const OptionValue& value, double bound) {
  if (std::holds_alternative<int>(value)) {
    using Limits = std::numeric_limits<int>;
    return static_cast<int>(std::clamp<double>(bound, Limits::min(), Limits::max()));
  }
  if (std::holds_alternative<double>(value)) {
    constexpr double kMax = std::numeric_limits<double>::max();
    return std::clamp(bound, -kMax, kMax);
  }
  return value;
}

/// An enumeration in the format of parameter_generator_catkin: text of a Python dictionary.
std::string editMethodOf(const LiveOption& option) {
  std::string choices;
  for (const std::string& choice : option.choices) {
    choices += std::string(choices.empty() ? "" : ", ") + "{'name': '" + choice + "', 'value': '" +
               choice + "', 'type': 'str', 'ctype': 'std::string', 'description': ''}";
  }
  return choices.empty() ? "" : "{'enum': [" + choices + "], 'enum_description': ''}";
}

dynamic_reconfigure::GroupState allGroup() {
  dynamic_reconfigure::GroupState group;
  group.name = "Default";
  group.state = true;
  return group;
}

bool isShown(const LiveOption& option) {
  return !std::holds_alternative<std::vector<double>>(option.value);
}

}  // namespace

dynamic_reconfigure::Config configOf(const std::vector<LiveOption>& options) {
  dynamic_reconfigure::Config config;
  for (const LiveOption& option : options) {
    std::visit(ConfigWriter{option.key, config}, option.value);
  }
  config.groups.push_back(allGroup());
  return config;
}

dynamic_reconfigure::ConfigDescription descriptionOf(const std::vector<LiveOption>& options) {
  dynamic_reconfigure::ConfigDescription description;
  dynamic_reconfigure::Group group;
  group.name = allGroup().name;
  for (const LiveOption& option : options) {
    if (!isShown(option)) {
      continue;
    }
    dynamic_reconfigure::ParamDescription shown;
    shown.name = option.key;
    shown.type = typeOf(option.value);
    shown.description = option.description;
    shown.edit_method = editMethodOf(option);
    group.parameters.push_back(shown);
    std::visit(ConfigWriter{option.key, description.dflt}, option.value);
    std::visit(ConfigWriter{option.key, description.min},
               boundLike(option.value, option.bounds.min));
    std::visit(ConfigWriter{option.key, description.max},
               boundLike(option.value, option.bounds.max));
  }
  description.groups.push_back(group);
  for (auto* config : {&description.dflt, &description.min, &description.max}) {
    config->groups.push_back(allGroup());
  }
  return description;
}

OptionValues valuesOf(const dynamic_reconfigure::Config& config) {
  OptionValues values;
  const auto add = [&values](const auto& parameters, auto type) {
    for (const auto& parameter : parameters) {
      values[parameter.name] = static_cast<decltype(type)>(parameter.value);
    }
  };
  add(config.bools, bool());
  add(config.ints, int());
  add(config.doubles, double());
  add(config.strs, std::string());
  return values;
}

}  // namespace datmo
