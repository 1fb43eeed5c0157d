// SPDX-License-Identifier: BSD-3-Clause
#include "stage_types.h"

#include <map>
#include <set>
#include <stdexcept>

#include "stage_list.h"
#include "stereo_images.h"

namespace datmo {

namespace {

template <typename MadeStage>
StageType typeOf() {
  using Options = typename MadeStage::Options;
  return {[](const OptionValues& values, const SharedOptions& shared) {
            readStageOptions<Options>(values, shared);
          },
          [](const OptionValues& values, const SharedOptions& shared, const StageContext& context) {
            return makeStage<MadeStage>(readStageOptions<Options>(values, shared), context);
          }};
}

std::map<std::string, StageType> allTypes() {
  // Live, another package provides it.
  std::map<std::string, StageType> types{{"stereo_image_proc", typeOf<StereoImages>()}};
  forEachStage([&types](auto tag, const char* name) {
    types[name] = typeOf<typename decltype(tag)::Stage>();
  });
  return types;
}

const std::map<std::string, StageType>& stageTypes() {
  static const std::map<std::string, StageType> types = allTypes();
  return types;
}

std::string withoutEntry(const std::string& type) {
  return "stageGraph() has a stage of type '" + type + "': expected a class datmo_fusion/" + type +
         " in nodelets.xml and src/ros/stage/" + type + "_stage.cpp";
}

}  // namespace

const StageType& stageTypeNamed(const std::string& type) {
  const auto found = stageTypes().find(type);
  if (found == stageTypes().end()) {
    throw std::logic_error(withoutEntry(type));
  }
  return found->second;
}

void checkStageTypes(const std::vector<GraphStage>& graph) {
  std::set<std::string> in_graph;
  for (const GraphStage& stage : graph) {
    in_graph.insert(stage.type);
  }
  std::string missing;
  const auto add = [&missing](const std::string& what) {
    missing += (missing.empty() ? "" : "; ") + what;
  };
  for (const std::string& type : in_graph) {
    if (stageTypes().count(type) == 0) {
      add(withoutEntry(type));
    }
  }
  for (const auto& [type, unused] : stageTypes()) {
    if (in_graph.count(type) == 0) {
      add("nodelets.xml has the stage datmo_fusion/" + type + ": expected a row '" + type +
          "' in src/ros/stage/stage_graph.cpp");
    }
  }
  if (!missing.empty()) {
    throw std::logic_error(missing);
  }
}

}  // namespace datmo
