// SPDX-License-Identifier: BSD-3-Clause
#include "argument_checks.h"

#include "command_line.h"
#include "output_bag.h"

#include "datmo_fusion/ros/map_files.h"

namespace datmo {

namespace {

/// The error of an option that does not go with an --until before this stage.
UsageError tooEarlyEnd(const std::string& option, LastStage stage) {
  return UsageError(option + ": expected no --until before " + stageType(stage));
}

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
  for (const NamedLastStage& one : lastStages()) {
    if (one.enabled_by == nullptr) {
      continue;
    }
    const std::string option = optionOf(one.enabled_by);
    const bool is_fusion = one.stage == LastStage::kObjectFusion;
    const std::string source = is_fusion ? arguments.fusedSource() : "";
    const bool is_given = arguments.*one.enabled_by || !source.empty();
    if (arguments.last_stage == one.stage && !is_given) {
      throw UsageError("--until " + stageType(one.stage) + ": expected " + option + " with it");
    }
    if (arguments.last_stage < one.earliest_end && is_given) {
      throw tooEarlyEnd(source.empty() ? option : source, one.earliest_end);
    }
  }
}

void checkMaps(const Arguments& arguments) {
  if (arguments.last_stage <= LastStage::kGridSlam && arguments.map_fusion) {
    throw tooEarlyEnd(optionOf(&StackSwitches::map_fusion), LastStage::kLoopClosing);
  }
  if (arguments.last_stage < LastStage::kGridSlam &&
      !(arguments.map.empty() && arguments.save_map.empty())) {
    throw tooEarlyEnd(arguments.map.empty() ? "--save-map" : "--map", LastStage::kGridSlam);
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

void checkJobs(const Arguments& arguments) {
  constexpr int kMaxJobs = 1024;  // more than the processors of one machine
  if (arguments.jobs < 1 || arguments.jobs > kMaxJobs) {
    throw UsageError("--jobs " + std::to_string(arguments.jobs) + ": expected 1 to " +
                     std::to_string(kMaxJobs));
  }
}

}  // namespace

void checkArguments(const Arguments& arguments) {
  checkOutputs(arguments);
  checkStages(arguments);
  checkMaps(arguments);
  checkStereo(arguments);
  checkJobs(arguments);
}

}  // namespace datmo
