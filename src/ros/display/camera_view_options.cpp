// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/camera_view_options.h"

namespace datmo {

void CameraViewOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"max_distance", "m", "tracks farther from the camera are not drawn", Tier::kPublic},
      max_distance, {1.0, 1000.0});
  visitor.number({"track_timeout", "s",
                  "maximum time over which tracks are predicted to the image's stamp; without such "
                  "tracks the image is shown without boxes"},
                 track_timeout, {0.0, 10.0});
  visitor.number({"wait", "s", "longest time that an image waits for its transform and tracks"},
                 wait, {0.0, 5.0});
  visitor.number({"default_height", "m", "height of a box whose height is not measured"},
                 default_height, {0.01, 10.0});
  visitor.number({"min_size", "m", "minimum length and width of a box as drawn"}, min_size,
                 {0.01, 10.0});
  visitor.number({"text_height", "px", "height of the letters", Tier::kPublic}, text_height,
                 {5.0, 100.0});
  visitor.integer({"line_width", "px", "width of the boxes' edges"}, line_width, {1.0, 20.0});
  visitor.group("input", [&] { input.visit(visitor); });
}

}  // namespace datmo
