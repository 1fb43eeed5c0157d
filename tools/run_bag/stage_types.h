// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "datmo_fusion/ros/stage/stage_factory.h"

namespace datmo {

/// How a stage of one type is made from values of its section.
struct StageType {
  /// Throws OptionError.
  std::function<void(const OptionValues&, const SharedOptions&)> check;
  std::function<std::unique_ptr<Stage>(const OptionValues&, const SharedOptions&,
                                       const StageContext&)>
      make;
};

/// By the types of the graph's stages.
const std::map<std::string, StageType>& stageTypes();

}  // namespace datmo
