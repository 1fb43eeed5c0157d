// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/camera_input.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <image_geometry/pinhole_camera_model.h>

#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

std::string sizeText(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

}  // namespace

void CameraInput::update(const sensor_msgs::CameraInfo& message) {
  const auto& p = message.P;
  const bool finite =
      std::all_of(p.begin(), p.end(), [](double value) { return std::isfinite(value); });
  if (!finite || p[0] <= 0.0 || p[5] <= 0.0) {
    throw InputError("bad_camera_info", "camera info whose matrix P has focal lengths " +
                                            std::to_string(p[0]) + " and " + std::to_string(p[5]) +
                                            " px: expected more than 0, from a calibrated camera");
  }
  image_geometry::PinholeCameraModel model;
  model.fromCameraInfo(message);
  info_ = message;
  camera_ = PinholeCamera{model.fx(), model.fy(), model.cx(), model.cy()};
  shift_ = -model.Tx() / model.fx();
}

void CameraInput::check(const sensor_msgs::Image& image) const {
  if (!camera_) {
    throw InputError("missing_camera_info",
                     "no camera info received for the images: expected one with their size and "
                     "frame (argument camera_info of perception.launch)");
  }
  if (image.width != info_.width || image.height != info_.height) {
    throw InputError("wrong_size", "image of " + sizeText(image.width, image.height) +
                                       ", but its camera info says " +
                                       sizeText(info_.width, info_.height) +
                                       ": expected the rectified image of that camera");
  }
  if (image.header.frame_id != info_.header.frame_id) {
    throw InputError("wrong_frame", "image in frame '" + image.header.frame_id +
                                        "', but its camera info is in '" + info_.header.frame_id +
                                        "': expected both from the same camera");
  }
}

MountedCamera CameraInput::mounted(const sensor_msgs::Image& image, const FrameOptions& frames,
                                   const TransformBuffer& transforms) const {
  check(image);  // the info may have changed while the image waited
  MountedCamera camera;
  camera.pinhole = pinhole();
  camera.width = width();
  camera.height = height();
  camera.in_base = sensorMount(transforms.core(), frames.base,
                               frames.camera.empty() ? image.header.frame_id : frames.camera);
  camera.in_base.translate(Eigen::Vector3d(shift_, 0.0, 0.0));
  return camera;
}

}  // namespace datmo
