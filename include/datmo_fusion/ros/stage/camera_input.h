// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/transform_buffer.h"
#include "datmo_fusion/vision/image_region.h"

namespace datmo {

/// Input check of one camera's rectified images: their info, and whether an image is that camera's.
class CameraInput {
 public:
  /// The newest one serves; its matrix P. Throws InputError (`bad_camera_info`): the last good one
  /// goes on serving.
  void take(const sensor_msgs::CameraInfo& message);

  /// Throws InputError (`missing_camera_info`, `wrong_size`, `wrong_frame`).
  void check(const sensor_msgs::Image& image) const;

  /// The camera of an image on the vehicle, as tf knows it. Throws InputError
  /// (`missing_transform`), and std::bad_optional_access before the first info.
  MountedCamera mounted(const sensor_msgs::Image& image, const FrameOptions& frames,
                        const TransformBuffer& transforms) const;

  /// What an info has said. Throws std::bad_optional_access before the first.
  const PinholeCamera& pinhole() const { return camera_.value(); }
  double width() const { return info_.width; }    ///< px
  double height() const { return info_.height; }  ///< px
  /// m, of the camera to the right of its frame's origin: that of the left one.
  double shift() const { return shift_; }

 private:
  sensor_msgs::CameraInfo info_;
  std::optional<PinholeCamera> camera_;
  double shift_ = 0.0;
};

}  // namespace datmo
