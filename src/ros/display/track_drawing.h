// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/display/camera_view_options.h"
#include "datmo_fusion/vision/box_projection.h"

namespace datmo {

/// A track prepared for drawing on a camera image.
struct TrackBox {
  Box3 box;               ///< in the camera's frame
  double distance = 0.0;  ///< m, from the camera
  ObjectClass object_class = ObjectClass::kUnknown;
  cv::Scalar color;      ///< blue, green, red
  double opacity = 1.0;  ///< 0 to 1
  std::string text;      ///< "#id class speed", the class if known, the speed if moving
};

/// Returns a track `later` seconds after its stamp (negative: before), moved by its velocity, with
/// an opacity that depends on its existence.
TrackBox trackBox(const TrackMessage& track, double later, const Eigen::Isometry3d& fixed_in_camera,
                  const CameraViewOptions& options);

/// Draws boxes with their labels, class icons and distances on a bgr8 image. Labels are just above
/// their boxes, or higher to avoid covering that of a nearer track.
void drawTrackBoxes(const PinholeCamera& camera, std::vector<TrackBox> boxes,
                    const CameraViewOptions& options, cv::Mat& canvas);

}  // namespace datmo
