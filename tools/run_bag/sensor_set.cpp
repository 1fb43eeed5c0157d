// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_set.h"

#include <algorithm>
#include <vector>

#include "stage_types.h"
#include "yaml_options.h"
#include <yaml-cpp/yaml.h>

#include "datmo_fusion/common/nearest_name.h"
#include "datmo_fusion/ros/stage/stage_graph.h"

namespace datmo {

namespace {

/// Nodes that are not stages: they run only live.
const std::vector<std::string> kLiveNodes = {
    "markers",     "lidar_markers",      "stereo_markers", "grid_views", "camera_view", "device",
    "rear_device", "satellite_receiver", "vehicle_bus",    "v2x_wire",   "stack"};

/// All possible stages.
const std::vector<GraphStage>& wholeGraph() {
  static const std::vector<GraphStage> graph = stageGraph(allSwitches());
  return graph;
}

/// The type of the stage to which a section belongs; empty if it belongs to none.
std::string typeOf(const std::string& section) {
  for (const GraphStage& stage : wholeGraph()) {
    // The section `motion` of a sensor set is for all stages.
    if (stage.name == section && section != kMotionSection) {
      return stage.type;
    }
  }
  return "";
}

std::vector<std::string> sectionNames() {
  std::vector<std::string> names = sharedSections();
  for (const GraphStage& stage : wholeGraph()) {
    if (stage.name != kMotionSection) {
      names.push_back(stage.name);
    }
  }
  names.insert(names.end(), kLiveNodes.begin(), kLiveNodes.end());
  return names;
}

void checkSectionName(const std::string& file, const std::string& name) {
  const std::vector<std::string> names = sectionNames();
  if (std::find(names.begin(), names.end(), name) != names.end()) {
    return;
  }
  std::string list;
  for (const std::string& each : names) {
    list += (list.empty() ? "" : ", ") + each;
  }
  throw OptionError(file + ": " + name + ": no such section; the nearest one is " +
                    nearestName(name, {names.begin(), names.end()}) + " (there are " + list + ")");
}

}  // namespace

SensorSet::SensorSet(const std::string& file, const std::vector<std::string>& presets)
    : file_(file) {
  read(file);
  for (const std::string& preset : presets) {
    read(preset);
    file_ += " with " + preset;
  }
  readShared();
  for (const GraphStage& stage : wholeGraph()) {
    check(stage.name);
  }
}

void SensorSet::read(const std::string& file) {
  const YAML::Node root = loadYaml(file);
  if (!root.IsMap()) {
    throw OptionError(file + ": expected sections: frames, grid_slam, tracker and others");
  }
  for (const auto& entry : root) {
    checkSectionName(file, keyOf(entry.first));
  }
  for (const auto& entry : root) {
    const std::string name = keyOf(entry.first);
    if (std::find(kLiveNodes.begin(), kLiveNodes.end(), name) == kLiveNodes.end()) {
      for (auto& [key, value] : optionValues(entry.second)) {
        sections_[name][key] = value;
      }
    }
  }
}

OptionValues SensorSet::values(const std::string& section) const {
  const auto found = sections_.find(section);
  return found == sections_.end() ? OptionValues() : found->second;
}

void SensorSet::set(const std::string& section, const std::string& key, const OptionValue& value) {
  sections_[section][key] = value;
  readShared();
  check(section);
}

void SensorSet::readShared() {
  try {
    shared_ = readSharedOptions([this](const std::string& section) { return values(section); });
  } catch (const OptionError& error) {
    throw OptionError(file_ + ": " + error.what());
  }
}

void SensorSet::check(const std::string& section) const {
  const std::string type = typeOf(section);
  if (type.empty()) {
    return;
  }
  try {
    stageTypeNamed(type).check(values(section), shared_);
  } catch (const OptionError& error) {
    throw OptionError(file_ + ": " + section + ": " + error.what());
  }
}

}  // namespace datmo
