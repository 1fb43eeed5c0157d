// SPDX-License-Identifier: BSD-3-Clause
#include "stage_types.h"

#include <map>
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
  // Live it is another package's.
  std::map<std::string, StageType> types{{"stereo_image_proc", typeOf<StereoImages>()}};
  forEachStage([&types](auto tag, const char* name) {
    types[name] = typeOf<typename decltype(tag)::Stage>();
  });
  return types;
}

}  // namespace

const StageType& stageTypeNamed(const std::string& type) {
  static const std::map<std::string, StageType> types = allTypes();
  const auto found = types.find(type);
  if (found == types.end()) {
    throw std::logic_error("stageGraph() has a stage of type '" + type +
                           "': expected a class datmo_fusion/" + type +
                           " in nodelets.xml and src/ros/stage/" + type + "_stage.cpp");
  }
  return found->second;
}

}  // namespace datmo
