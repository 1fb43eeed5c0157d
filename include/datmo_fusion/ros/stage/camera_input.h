// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/vision/image_region.h"

namespace datmo {

/// Input check of one camera's rectified images: camera info, and whether images match it.
class CameraInput {
 public:
  /// Sets the camera info (its matrix P); the newest is used. Throws InputError (`bad_camera_info`)
  /// and keeps the last good one.
  void update(const sensor_msgs::CameraInfo& message);

  /// Throws InputError (`missing_camera_info`, `wrong_size`, `wrong_frame`).
  void check(const sensor_msgs::Image& image) const;

  /// Returns the camera of an image on the vehicle, with its mount from tf. Throws InputError for
  /// the same reasons as check(), since the info may have changed, and `missing_transform`.
  MountedCamera mounted(const sensor_msgs::Image& image, const FrameOptions& frames,
                        const TransformBuffer& transforms) const;

  /// Returns the camera of the last info. Throws std::bad_optional_access before the first.
  const PinholeCamera& pinhole() const { return camera_.value(); }
  double width() const { return info_.width; }    ///< px
  double height() const { return info_.height; }  ///< px
  /// m, from the frame's origin (the left camera) to the camera, to the right.
  double shift() const { return shift_; }

 private:
  sensor_msgs::CameraInfo info_;
  std::optional<PinholeCamera> camera_;
  double shift_ = 0.0;
};

}  // namespace datmo
