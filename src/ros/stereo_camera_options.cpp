// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stereo_camera_options.h"

#include "datmo_fusion/ros/convert/cloud_conversion.h"

namespace datmo {

void StereoCameraOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"focal_length", "px", "until a camera info is received; 0: unknown", Tier::kPublic},
      focal_length, {0.0, kMaxFocalLength});
  visitor.number({"baseline", "m",
                  "stereo: until a camera info is received, 0: unknown; active_stereo: between its "
                  "two cameras; structured_light: from the camera to the projector on its right",
                  Tier::kPublic},
                 baseline, {0.0, kMaxBaseline});
  visitor.number({"field_of_view", "rad", "from left to right, until a camera info is received",
                  Tier::kPublic},
                 field_of_view, {degrees(5.0), degrees(150.0)});
  visitor.number({"min_depth", "m",
                  "nearer points are left out: the camera's data sheet; 0: unknown, and those "
                  "nearer than 0.5 m are mismatches",
                  Tier::kPublic},
                 min_depth, {0.0, 10.0});
  visitor.number(
      {"max_depth", "m", "farther points are left out: the camera's data sheet; 0: none are"},
      max_depth, {0.0, 1000.0});
  visitor.toggle({"align", "",
                  "corrects the points for the bias of disparities that stereo_alignment measures "
                  "against the scanner; they are left out while the mount or clock is certainly "
                  "wrong, or camera and scanner do not agree"},
                 align);
  DepthNoiseOptions::visit(visitor);
}

void StereoSceneOptions::visit(OptionVisitor& visitor) {
  StereoCameraOptions::visit(visitor);
  RoadSceneOptions::visit(visitor);
}

}  // namespace datmo
