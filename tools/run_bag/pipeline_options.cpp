#include "pipeline_options.h"

#include <algorithm>
#include <array>

#include "yaml_options.h"
#include <yaml-cpp/yaml.h>

#include "datmo_fusion/common/nearest_name.h"

namespace datmo {

namespace {

/// What all share, and one for each nodelet; those without a stage in the pipeline are for live use
/// alone.
const std::array<std::string, 21> kSections = {
    kFramesSection,   kMountsSection,   kMotionSection,  "cloud_to_scan",  "stereo_image_proc",
    "lidar_grid",     "stereo_grid",    "grid_fusion",   "grid_slam",      "road_border",
    "moving_objects", "stereo_objects", "object_fusion", "tracker",        "stereo_tracker",
    "track_fusion",   "markers",        "lidar_markers", "stereo_markers", "grid_views",
    "camera_view"};

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
      throw OptionError(file + ": " + name + ": no such section; the nearest one is " +
                        nearestName(name, {kSections.begin(), kSections.end()}) + " (there are " +
                        sectionNames() + ")");
    }
  }
}

OptionValues sectionValues(const YAML::Node& root, const char* section) {
  const YAML::Node node = root[section];
  return node ? optionValues(node) : OptionValues();
}

SharedOptions readShared(const std::string& file, const YAML::Node& root) {
  try {
    return readSharedOptions(sectionValues(root, kFramesSection),
                             sectionValues(root, kMountsSection),
                             sectionValues(root, kMotionSection));
  } catch (const OptionError& error) {
    throw OptionError(file + ": " + error.what());
  }
}

template <typename Options>
Options readSection(const std::string& file, const YAML::Node& root, const char* section,
                    const SharedOptions& shared) {
  try {
    return readStageOptions<Options>(sectionValues(root, section), shared);
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
  const SharedOptions shared = readShared(file, root);
  return {readSection<CloudToScanStageOptions>(file, root, "cloud_to_scan", shared),
          readSection<StereoImagesOptions>(file, root, "stereo_image_proc", shared),
          {readSection<LidarGridStageOptions>(file, root, "lidar_grid", shared),
           readSection<StereoGridStageOptions>(file, root, "stereo_grid", shared),
           readSection<GridFusionStageOptions>(file, root, "grid_fusion", shared)},
          readSection<GridSlamStageOptions>(file, root, "grid_slam", shared),
          readSection<RoadBorderStageOptions>(file, root, "road_border", shared),
          readSection<MovingObjectsStageOptions>(file, root, "moving_objects", shared),
          readSection<StereoObjectsStageOptions>(file, root, "stereo_objects", shared),
          readSection<ObjectFusionStageOptions>(file, root, "object_fusion", shared),
          readSection<TrackerStageOptions>(file, root, "tracker", shared),
          {readSection<TrackerStageOptions>(file, root, "stereo_tracker", shared),
           readSection<TrackFusionStageOptions>(file, root, "track_fusion", shared)},
          shared};
}

}  // namespace datmo
