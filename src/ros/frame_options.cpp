// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/frame_options.h"

namespace datmo {

void FrameOptions::visit(OptionVisitor& visitor) {
  visitor.text({"map", "", "fixed frame of the map, the pose and the tracks", Tier::kPublic}, map,
               {});
  visitor.text({"odom", "", "frame of the odometry", Tier::kPublic}, odom, {});
  visitor.text({"base", "", "frame of the vehicle", Tier::kPublic}, base, {});
  visitor.text(
      {"scanner", "",
       "frame of the planar scanner, whose height is the lower bound of stereo_grid's layer of "
       "obstacles (thesis 3.2.2); empty: stereo_grid/scanner_height gives the height",
       Tier::kPublic},
      scanner, {});
  visitor.text({"camera", "",
                "optical frame of the stereo camera's left camera (x to the right, y down, z "
                "forward); empty: the frame of its clouds",
                Tier::kPublic},
               camera, {});
  visitor.text({"prefix", "",
                "prefix of the names of all frames here, in `mounts` and in the stages: `car1/` if "
                "several vehicles share one tf"},
               prefix, {});
}

void checkFrames(const FrameOptions& frames) {
  const auto& [map, odom, base, scanner, camera, prefix] = frames;
  if (map.empty() || odom.empty() || base.empty() || map == odom || odom == base || base == map) {
    throw OptionError("map = '" + map + "', odom = '" + odom + "', base = '" + base +
                      "': expected three different names");
  }
}

}  // namespace datmo
