// SPDX-License-Identifier: BSD-3-Clause
// Prints the graph of stages as JSON, for the test that compares perception.launch with it:
// print_stage_graph [SWITCH...], e.g. low_level_fusion; print_stage_graph --switches: their names.
// Exit code 1 with a message if the graph and nodelets.xml do not match.
#include <cstdlib>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "command_line.h"
#include "run_bag/stage_types.h"
#include <nlohmann/json.hpp>

#include "datmo_fusion/ros/stage/stage_graph.h"

namespace {

std::string nameOf(datmo::StackPart part) {
  switch (part) {
    case datmo::StackPart::kSensors:
      return "sensors";
    case datmo::StackPart::kStereo:
      return "stereo";
    case datmo::StackPart::kPerception:
      break;
    case datmo::StackPart::kRisk:
      return "risk";
  }
  return "perception";
}

/// Inputs and outputs of a stage: the graph's topics with their types.
class TopicList : public datmo::StagePorts {
 public:
  explicit TopicList(const datmo::GraphStage& stage) : stage_(stage) {}

  std::map<std::string, std::string> inputs;
  std::map<std::string, std::string> outputs;

 private:
  void addInput(datmo::StageInput input) override {
    inputs[stage_.resolved(input.topic)] = input.data_type;
  }
  datmo::StageOutput::Publish addOutput(datmo::StageOutput output) override {
    outputs[stage_.resolved(output.topic)] = output.data_type;
    return {};
  }

  const datmo::GraphStage& stage_;
};

nlohmann::json toJson(const datmo::GraphStage& stage) {
  nlohmann::json parameters = nlohmann::json::object();
  for (const auto& [key, value] : stage.parameters) {
    std::visit([&, name = key](const auto& plain) { parameters[name] = plain; }, value);
  }
  nlohmann::json remaps = nlohmann::json::object();
  for (const auto& [from, to] : stage.remaps) {
    if (from != to) {
      remaps[from] = to;
    }
  }
  datmo::StageMonitor monitor(stage.name);
  const datmo::TransformBuffer transforms(datmo::StreamOptions().restart_after);
  const auto made =
      datmo::stageTypeNamed(stage.type).make(stage.parameters, {}, {transforms, monitor, {}});
  TopicList topics(stage);
  made->connect(topics);
  return {{"type", stage.type},         {"remaps", remaps},        {"parameters", parameters},
          {"part", nameOf(stage.part)}, {"inputs", topics.inputs}, {"outputs", topics.outputs}};
}

nlohmann::json switchNames() {
  nlohmann::json names = nlohmann::json::array();
  for (const datmo::NamedSwitch& each : datmo::stackSwitches()) {
    names.push_back(each.name);
  }
  return names;
}

/// The stages that run with some switches on, by their names.
nlohmann::json stagesWith(const std::set<std::string>& on) {
  const auto is_on = [&on](const std::string& name) { return on.count(name) > 0; };
  datmo::GraphSwitches switches;
  for (const datmo::NamedSwitch& each : datmo::stackSwitches()) {
    switches.*each.value = is_on(each.name);
  }
  switches.scan_from_cloud = is_on("cloud");
  switches.stereo = is_on("rectified_images") ? datmo::StereoPoints::kRectifiedImages
                                              : datmo::StereoPoints::kClouds;
  switches.stereo_objects = is_on("stereo_objects");
  switches.stereo_tracker = is_on("track_fusion");
  nlohmann::json stages = nlohmann::json::object();
  for (const datmo::GraphStage& stage : stageGraph(switches)) {
    stages[stage.name] = toJson(stage);
  }
  return stages;
}

}  // namespace

int main(int count, char** words) {
  return datmo::runProgram("print_stage_graph", EXIT_FAILURE, count, words, [](const auto& given) {
    datmo::checkStageTypes(stageGraph(datmo::allSwitches()));
    const std::set<std::string> on(given.begin(), given.end());
    std::cout << (on.count("--switches") > 0 ? switchNames() : stagesWith(on)) << '\n';
  });
}
