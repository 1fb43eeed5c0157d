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

/// Between the rectified camera, in which KITTI gives boxes, and the ground plane in the vehicle's
/// frame (base_link: below the IMU, x forward, y left), and on to the image.
///
/// The ground plane is taken to be the camera's x-z plane: pitch and roll are left out, in both
/// directions alike.
class CameraMount {
 public:
  CameraMount(const Calibration& calibration, const ImageSize& image);

  const Pose2& cameraInBase() const { return camera_in_base_; }

  /// The box as seen from above, vehicle's frame.
  Box2 onGround(const Box3& box) const;

  /// The other way round: `bottom` and `height` (m) are y of the lower face in the camera's frame
  /// and how far the box reaches up from there.
  Box3 standing(const Box2& box_in_base, double bottom, double height) const;

  /// Around the box in the image, cut at its borders; without area where none of it is seen.
  ImageBox inImage(const Box3& box) const;

  /// Whether a box of inImage() keeps clear of the left and the right border.
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
