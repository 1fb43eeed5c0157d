// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "datmo_fusion/ros/stage/stage_factory.h"
#include "datmo_fusion/ros/stage/stage_graph.h"

namespace datmo {

/// Creates a stage of one type from the values of its section.
struct StageType {
  /// Throws OptionError.
  std::function<void(const OptionValues&, const SharedOptions&)> check;
  std::function<std::unique_ptr<Stage>(const OptionValues&, const SharedOptions&,
                                       const StageContext&)>
      make;
};

/// By the type of a stage of the graph. Throws std::logic_error for one that is missing in
/// nodelets.xml.
const StageType& stageTypeNamed(const std::string& type);

/// Compares a graph with all switches on to nodelets.xml. Throws std::logic_error that names each
/// type without an entry in that file, and each stage in it without a row in the graph.
void checkStageTypes(const std::vector<GraphStage>& graph);

}  // namespace datmo
