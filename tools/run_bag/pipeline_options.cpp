#include "pipeline_options.h"

#include <algorithm>
#include <array>

#include "yaml_options.h"
#include <yaml-cpp/yaml.h>

namespace datmo {

namespace {

/// One for each nodelet; those without a stage in the pipeline are for live use alone.
const std::array<std::string, 16> kSections = {
    "stereo_image_proc", "lidar_grid",    "stereo_grid",    "grid_fusion",
    "grid_slam",         "road_border",   "moving_objects", "stereo_objects",
    "object_fusion",     "tracker",       "stereo_tracker", "track_fusion",
    "markers",           "lidar_markers", "stereo_markers", "grid_views"};

std::string sectionNames() {
  std::string names;
  for (const std::string& section : kSections) {
    names += names.empty() ? section : ", " + section;
  }
  return names;
}

void checkSections(const std::string& file, const YAML::Node& root) {
  for (const auto& entry : root) {
    const std::string name = keyOf(entry.first);
    if (std::find(kSections.begin(), kSections.end(), name) == kSections.end()) {
      throw OptionError(file + ": " + name + ": expected one of " + sectionNames());
    }
  }
}

template <typename Options>
Options readSection(const std::string& file, const YAML::Node& root, const std::string& section) {
  try {
    const YAML::Node node = root[section];
    return node ? readOptions<Options>(optionValues(node)) : Options();
  } catch (const OptionError& error) {
    throw OptionError(file + ": " + section + ": " + error.what());
  }
}

}  // namespace

PipelineOptions readPipelineOptions(const std::string& file) {
  const YAML::Node root = loadYaml(file);
  if (!root.IsMap()) {
    throw OptionError(file + ": expected sections: " + sectionNames());
  }
  checkSections(file, root);
  return {readSection<StereoImagesOptions>(file, root, "stereo_image_proc"),
          {readSection<LidarGridStageOptions>(file, root, "lidar_grid"),
           readSection<StereoGridStageOptions>(file, root, "stereo_grid"),
           readSection<GridFusionStageOptions>(file, root, "grid_fusion")},
          readSection<GridSlamStageOptions>(file, root, "grid_slam"),
          readSection<RoadBorderStageOptions>(file, root, "road_border"),
          readSection<MovingObjectsStageOptions>(file, root, "moving_objects"),
          readSection<StereoObjectsStageOptions>(file, root, "stereo_objects"),
          readSection<ObjectFusionStageOptions>(file, root, "object_fusion"),
          readSection<TrackerStageOptions>(file, root, "tracker"),
          {readSection<TrackerStageOptions>(file, root, "stereo_tracker"),
           readSection<TrackFusionStageOptions>(file, root, "track_fusion")}};
}

}  // namespace datmo
