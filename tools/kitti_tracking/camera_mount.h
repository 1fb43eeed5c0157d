// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kitti_tracking/box3_overlap.h"
#include "kitti_tracking/kitti_calibration.h"
#include "kitti_tracking/kitti_tracking_files.h"

#include "datmo_fusion/common/box2.h"

namespace datmo::kitti {

/// Size of the left color image, px. KITTI's rectified images differ by some pixels.
struct ImageSize {
  double width = 1242.0;
  double height = 375.0;
};

/// Transforms between the frame of the rectified camera, in which KITTI gives boxes, and the ground
/// plane in the vehicle's frame (base_link: below the IMU, x forward, y left), and to the image.
///
/// The ground plane is assumed to be the camera's x-z plane: pitch and roll are ignored, in both
/// directions.
class CameraMount {
 public:
  CameraMount(const Calibration& calibration, const ImageSize& image);

  const Pose2& cameraInBase() const { return camera_in_base_; }

  /// The box as seen from above, vehicle's frame.
  Box2 onGround(const Box3& box) const;

  /// The inverse: `bottom` and `height` (m) are y of the lower face in the camera's frame and the
  /// extent of the box upward from there.
  Box3 standing(const Box2& box_in_base, double bottom, double height) const;

  /// The rectangle around the box in the image, clipped at its borders; without area if none of it
  /// is visible.
  ImageBox inImage(const Box3& box) const;

  /// Whether a rectangle of inImage() does not touch the left and the right border.
  bool isWithinImage(const ImageBox& box) const {
    return box.left > 0.0 && box.right < image_.width - 1.0;
  }

  /// Heading as seen from the camera, rad: rotation_y minus the viewing direction.
  static double alpha(const Box3& box);

  /// Bearings about the camera, rad to the left, that are in the image.
  double minBearing() const;
  double maxBearing() const;

 private:
  double bearingOf(double column) const;

  Projection image_from_camera_;
  ImageSize image_;
  Pose2 camera_in_base_;
};

}  // namespace datmo::kitti
