// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/scene_reader.h"

#include <stdexcept>

namespace datmo::simulator {

void readAt(const std::string& location, const std::function<void()>& read) {
  try {
    read();
  } catch (const std::invalid_argument& error) {
    throw OptionError(location + ": " + error.what());
  }
}

std::vector<std::vector<double>> readRows(const std::string& key, const YAML::Node& node,
                                          std::size_t columns) {
  const std::string expected =
      ": expected a list of lists of " + std::to_string(columns) + " numbers";
  if (!node.IsDefined()) {
    throw OptionError(key + " is missing" + expected);
  }
  std::vector<std::vector<double>> rows;
  try {
    rows = node.as<std::vector<std::vector<double>>>();
  } catch (const YAML::Exception&) {
    throw OptionError(key + " has another type" + expected);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != columns) {
      throw OptionError(key + "[" + std::to_string(i) + "] has " + std::to_string(rows[i].size()) +
                        " numbers" + expected);
    }
  }
  return rows;
}

Polyline readPoints(const YAML::Node& entry, const std::string& key) {
  Polyline points;
  for (const std::vector<double>& row : readRows(key, entry[key], 2)) {
    points.emplace_back(row[0], row[1]);
  }
  return points;
}

SpeedProfile readSpeed(const YAML::Node& entry) {
  std::vector<SpeedPoint> points;
  for (const std::vector<double>& row : readRows("speed", entry["speed"], 2)) {
    points.push_back({row[0], row[1]});
  }
  return SpeedProfile(points);
}

void readList(const YAML::Node& scene, const std::string& key,
              const std::function<void(const YAML::Node&)>& read) {
  const YAML::Node list = scene[key];
  if (!list.IsDefined()) {
    return;
  }
  if (!list.IsSequence()) {
    throw OptionError(key + ": expected a list of entries");
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    readAt(key + "[" + std::to_string(i) + "]", [&] { read(list[i]); });
  }
}

void expectKeys(const YAML::Node& node, const std::set<std::string>& known) {
  std::string names;
  for (const std::string& key : known) {
    names += names.empty() ? key : ", " + key;
  }
  if (!node.IsMap()) {
    throw OptionError("expected the sections " + names);
  }
  for (const auto& entry : node) {
    const std::string key = keyOf(entry.first);
    if (known.count(key) == 0) {
      throw OptionError(key + ": expected one of the sections " + names);
    }
  }
}

}  // namespace datmo::simulator
