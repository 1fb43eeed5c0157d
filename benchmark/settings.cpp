#include "settings.h"

#include "run_bag/pipeline_options.h"

namespace datmo {

namespace {

Settings settingsOf(int beams, const char* file) {
  const PipelineOptions options = readPipelineOptions(file);
  return {beams, options.grid_slam.slam, options.road_border.detector};
}

}  // namespace

Settings demonstratorSettings() {
  return settingsOf(81, DATMO_FUSION_SOURCE_DIR "/config/demonstrator.yaml");
}

Settings heavySettings() {
  return settingsOf(641, DATMO_FUSION_SOURCE_DIR "/benchmark/heavy.yaml");
}

}  // namespace datmo
