// SPDX-License-Identifier: BSD-3-Clause
#include <iterator>

#include "datmo_fusion/ros/stage/stage_graph.h"

namespace datmo {

const std::vector<NamedSwitch>& stackSwitches() {
  static const NamedSwitch rows[] = {
      {"low_level_fusion", &StackSwitches::low_level_fusion,
       "fuses the grids of scanner and stereo camera before grid_slam"},
      {"map_fusion", &StackSwitches::map_fusion,
       "fuses a map of each sensor, and --map: writes /map/fused, /map/conflicts and,\n"
       "with --map, /map/changes"},
      {"road_border", &StackSwitches::road_border,
       "finds the borders of the road, on and beyond which objects are less likely to move,\n"
       "and writes /road_borders and /objects/dropped"},
      {"merge_scans", &StackSwitches::merge_scans,
       "merges the scans of several scanners (scan_merge/sources), with `front` on\n"
       "front_scan and `rear` on rear_scan, and writes /merged_scan"},
      {"cloud_objects", &StackSwitches::cloud_objects,
       "finds objects in a 3D lidar's clouds and fuses them with the scanner's before\n"
       "tracker, and writes /objects/cloud and /objects/fused"},
      {"radar", &StackSwitches::radar,
       "finds objects in a radar's detections (radar) and fuses them with the scanner's\n"
       "before tracker, and writes /objects/radar and /objects/fused"},
      {"mono", &StackSwitches::mono,
       "classifies the scanner's objects by images of the left camera, fuses with them what\n"
       "only these show, and writes /objects/classes, /objects/mono and /objects/fused; with\n"
       "--low-level-fusion they also identify the road by its colors, and --write-grids\n"
       "writes /grids/mono"},
      {"static_points", &StackSwitches::static_points,
       "writes stationary points: /static_points and /static_scan"},
      {"loop_closing", &StackSwitches::loop_closing,
       "closes loops after the SLAM, and writes /map/optimized, /trajectory/optimized and\n"
       "map -> global_map; --save-map then saves the optimized map"},
      {"object_fusion", &StackSwitches::object_fusion,
       "fuses the objects of scanner and stereo camera before tracker, and writes\n"
       "/objects/stereo and /objects/fused"},
      {"track_fusion", &StackSwitches::track_fusion,
       "tracks the stereo camera's objects too and fuses the tracks, and writes\n"
       "/tracks/lidar, /tracks/stereo and /objects/stereo"},
      {"v2x", &StackSwitches::v2x,
       "uses the tracks of other stations as source v2x of track_fusion, by the map's pose\n"
       "on the earth (gnss), and writes /earth_frame, /tracks/v2x and /stations/own"},
      {"risk", &StackSwitches::risk,
       "assesses the risk of contact with tracks and stationary things, and writes /risks"},
  };
  static_assert(std::size(rows) * sizeof(bool) == sizeof(StackSwitches), "a switch without a row");
  static const std::vector<NamedSwitch> switches(std::begin(rows), std::end(rows));
  return switches;
}

}  // namespace datmo
