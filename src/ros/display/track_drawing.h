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

/// A track as a camera image shows it.
struct TrackBox {
  Box3 box;               ///< in the camera's frame
  double distance = 0.0;  ///< m, from the camera
  ObjectClass object_class = ObjectClass::kUnknown;
  cv::Scalar color;      ///< blue, green, red
  double opacity = 1.0;  ///< 0 to 1
  std::string text;      ///< "#id class speed", the class where it is known, the speed if it moves
};

/// A track `later` seconds after its stamp (negative: before), moved by its velocity. The less
/// likely it exists, the fainter it is.
TrackBox trackBox(const TrackMessage& track, double later, const Eigen::Isometry3d& fixed_in_camera,
                  const CameraViewOptions& options);

/// Draws boxes with their labels, class icons and distances on a bgr8 image. The label of the
/// nearest is just above it, others higher where they would cover one of a nearer track.
void drawTrackBoxes(const PinholeCamera& camera, std::vector<TrackBox> boxes,
                    const CameraViewOptions& options, cv::Mat& canvas);

}  // namespace datmo
