#include "settings.h"

#include "run_bag/pipeline_options.h"

namespace datmo {

namespace {

Settings settingsOf(int beams, const char* file) {
  return {beams, readPipelineOptions(file).grid_slam.slam};
}

}  // namespace

Settings demonstratorSettings() {
  return settingsOf(81, DATMO_FUSION_SOURCE_DIR "/config/demonstrator.yaml");
}

Settings heavySettings() {
  return settingsOf(641, DATMO_FUSION_SOURCE_DIR "/benchmark/heavy.yaml");
}

}  // namespace datmo
