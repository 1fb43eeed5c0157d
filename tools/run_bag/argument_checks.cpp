// SPDX-License-Identifier: BSD-3-Clause
#include "argument_checks.h"

#include <algorithm>

#include "command_line.h"
#include "output_bag.h"

#include "datmo_fusion/ros/map_files.h"

namespace datmo {

namespace {

/// A stage that runs only with its option.
struct OptionalStage {
  const char* option;
  bool Arguments::*is_given;
  LastStage stage;
  LastStage earliest_end;  ///< earliest --until that includes it
};

constexpr OptionalStage kOptionalStages[] = {
    {"--low-level-fusion", &Arguments::low_level_fusion, LastStage::kGridFusion,
     LastStage::kGridFusion},
    {"--loop-closing", &Arguments::loop_closing, LastStage::kLoopClosing, LastStage::kLoopClosing},
    {"--road-border", &Arguments::road_border, LastStage::kRoadBorder, LastStage::kRoadBorder},
    {"--object-fusion", &Arguments::object_fusion, LastStage::kObjectFusion,
     LastStage::kObjectFusion},
    {"--track-fusion", &Arguments::track_fusion, LastStage::kTrackFusion, LastStage::kTracker},
    {"--risk", &Arguments::risk, LastStage::kRisk, LastStage::kRisk},
};

void checkOutputs(const Arguments& arguments) {
  std::vector<std::string> written;
  std::vector<std::string> outputs{arguments.output,   arguments.times,    arguments.report,
                                   arguments.save_map, arguments.text.tum, arguments.text.kitti,
                                   arguments.text.mot};
  if (!arguments.save_map.empty()) {
    const MapServerNames beside = mapServerNames(arguments.save_map);
    outputs.insert(outputs.end(), {beside.yaml, beside.image});
  }
  for (const std::string& file : outputs) {
    if (file.empty()) {
      continue;
    }
    std::vector<std::string> inputs = arguments.presets;
    inputs.insert(inputs.end(), {arguments.input, arguments.config});
    if (!arguments.map.empty()) {
      inputs.push_back(arguments.map);
    }
    for (const std::string& input : inputs) {
      if (isSameFile(file, input)) {
        throw UsageError("'" + input + "': the output must not be an input");
      }
    }
    for (const std::string& other : written) {
      if (isSameFile(file, other)) {
        throw UsageError("'" + file + "': expected another file for each output");
      }
    }
    written.push_back(file);
  }
}

void checkStages(const Arguments& arguments) {
  for (const OptionalStage& one : kOptionalStages) {
    const bool is_fusion = one.stage == LastStage::kObjectFusion;
    const std::string source = is_fusion ? arguments.fusedSource() : "";
    const std::string by = source.empty() ? one.option : source;
    const bool is_given = arguments.*one.is_given || !source.empty();
    if (arguments.last_stage == one.stage && !is_given) {
      throw UsageError("--until " + stageType(one.stage) + ": expected " + one.option + " with it");
    }
    if (arguments.last_stage < one.earliest_end && is_given) {
      throw UsageError(by + ": expected no --until before " + stageType(one.earliest_end));
    }
  }
}

void checkMaps(const Arguments& arguments) {
  if (arguments.last_stage <= LastStage::kGridSlam && arguments.map_fusion) {
    throw UsageError("--map-fusion: expected no --until before road_border");
  }
  if (arguments.last_stage < LastStage::kGridSlam &&
      !(arguments.map.empty() && arguments.save_map.empty())) {
    throw UsageError((arguments.map.empty() ? "--save-map" : "--map") +
                     std::string(": expected no --until before grid_slam"));
  }
}

void checkStereo(const Arguments& arguments) {
  if (arguments.stereo_from_images && !arguments.low_level_fusion && !arguments.map_fusion &&
      !arguments.object_fusion && !arguments.track_fusion) {
    throw UsageError(
        "--stereo-from-images: expected --low-level-fusion, --map-fusion, --object-fusion or "
        "--track-fusion with it");
  }
}

}  // namespace

void checkArguments(const Arguments& arguments) {
  checkOutputs(arguments);
  checkStages(arguments);
  checkMaps(arguments);
  checkStereo(arguments);
}

}  // namespace datmo
