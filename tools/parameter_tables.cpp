// SPDX-License-Identifier: BSD-3-Clause
#include "parameter_tables.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <type_traits>
#include <vector>

#include "stage_list.h"

#include "datmo_fusion/common/option_table.h"
#include "datmo_fusion/ros/device_options.h"
#include "datmo_fusion/ros/display/camera_view_options.h"
#include "datmo_fusion/ros/display/grid_views_options.h"
#include "datmo_fusion/ros/display/markers.h"
#include "datmo_fusion/ros/scanner_options.h"
#include "datmo_fusion/ros/shared_options.h"
#include "datmo_fusion/ros/stage/part_clocks.h"
#include "datmo_fusion/ros/stage/stage_graph.h"
#include "datmo_fusion/ros/station_wire.h"
#include "datmo_fusion/ros/stereo_camera_options.h"
#include "datmo_fusion/ros/vehicle_options.h"

namespace datmo {

namespace {

/// The options of a section of the sensor sets.
struct Section {
  std::string nodelets;
  std::string public_table;
  std::string expert_table;
};

/// The sections of all nodelets are listed only there.
template <typename Options>
Section section(const std::string& nodelets) {
  std::set<std::string> shared;
  for (const SharedKey& key : sharedKeysOf<Options>()) {
    shared.insert(key.own);
  }
  return {nodelets, publicOptionTable<Options>(shared), expertOptionTable<Options>(shared)};
}

constexpr const char* kHead =
    "# Parameters\n\n"
    "<!-- Made by list_parameters; do not edit. -->\n\n"
    "Keys of the sections of `config/*.yaml`, one section per nodelet. In the live system they "
    "are\n"
    "the nodelet's private parameters (`/grid_slam/map/cell_size`). A key that a sensor set does\n"
    "not give has its default value. A misspelled key, or a value out of range, is rejected with "
    "a\n"
    "message that names it.\n\n"
    "*Public* ones depend on the sensor, vehicle or city; those marked *live* may be changed "
    "while\n"
    "the nodelet runs (`rosrun dynamic_reconfigure dynparam set /NODELET NAME VALUE`, or with\n"
    "rqt_reconfigure, which Debian 12 does not have). *Expert* ones, below, belong to the method:\n"
    "where a description cites the thesis or a paper, read it before changing the value.\n\n";

constexpr const char* kPublicHead = "# Public parameters\n\n";
constexpr const char* kExpertHead = "# Expert parameters\n\n";

/// Of all stages.
std::vector<Section> commonSections() {
  return {section<FrameOptions>("`frames`, of all nodelets"),
          section<MountOptions>("`mounts/<frame>`, of all nodelets, for each sensor without tf"),
          section<MotionOptions>("`motion`, of all nodelets"),
          section<ScannerOptions>("`scanner`, of all nodelets"),
          section<StereoSceneOptions>("`stereo_camera`, of all nodelets"),
          section<VehicleOptions>("`vehicle`, of all nodelets")};
}

/// Of each stage that has one, in the order of the graph; stages of the same type share it.
std::vector<Section> stageSections() {
  std::map<std::string, Section> of_type;
  forEachStage([&of_type](auto tag, const std::string& type) {
    using Stage = typename decltype(tag)::Stage;
    if constexpr (!std::is_same_v<Stage, MotionStage>) {  // `motion` is a section of all stages
      of_type[type] = section<typename Stage::Options>("");
    }
  });
  std::vector<std::string> order;
  for (const GraphStage& stage : stageGraph(allSwitches())) {
    const auto found = of_type.find(stage.type);
    if (found == of_type.end()) {
      continue;
    }
    std::string& nodelets = found->second.nodelets;
    if (nodelets.empty()) {
      order.push_back(stage.type);
    }
    nodelets += (nodelets.empty() ? "`" : ", `") + stage.name + "`";
  }
  std::vector<Section> sections;
  std::transform(order.begin(), order.end(), std::back_inserter(sections),
                 [&of_type](const std::string& type) { return of_type[type]; });
  return sections;
}

/// Of nodelets that are not stages.
std::vector<Section> otherSections() {
  return {section<MarkersOptions>("`markers`, `lidar_markers`, `stereo_markers`"),
          section<GridViewsOptions>("`grid_views`"),
          section<CameraViewOptions>("`camera_view`"),
          section<DeviceOptions>("`device`"),
          section<StationWireOptions>("`v2x_wire`"),
          section<PartClocksOptions>("`stack`")};
}

std::vector<Section> sections() {
  std::vector<Section> all = commonSections();
  for (const std::vector<Section>& more : {stageSections(), otherSections()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

/// The sections that have such options.
std::string part(std::string Section::*table) {
  std::string page;
  for (const Section& section : sections()) {
    if (!(section.*table).empty()) {
      page += "## " + section.nodelets + "\n\n" + section.*table + "\n";
    }
  }
  return page;
}

}  // namespace

std::string parameterTables() {
  std::string page = kHead;
  page += kPublicHead + part(&Section::public_table);
  page += kExpertHead + part(&Section::expert_table);
  page.pop_back();  // the empty line after the last table
  return page;
}

}  // namespace datmo
