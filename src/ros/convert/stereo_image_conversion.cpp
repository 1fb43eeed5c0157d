// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/convert/stereo_image_conversion.h"

#include <cmath>
#include <cstddef>
#include <map>

#include <cv_bridge/cv_bridge.h>
#include <opencv2/imgproc.hpp>

#include <sensor_msgs/image_encodings.h>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo {

namespace {

namespace encodings = sensor_msgs::image_encodings;

/// Bytes per pixel of the supported encodings.
const std::map<std::string, std::size_t> kPixelSizes = {
    {encodings::MONO8, 1}, {encodings::RGB8, 3}, {encodings::BGR8, 3}};

std::string sizeText(std::size_t width, std::size_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

/// Throws InputError unless the calibration matches the image.
void checkInfo(const sensor_msgs::CameraInfo& info, const sensor_msgs::Image& image) {
  if (info.width != image.width || info.height != image.height) {
    throw InputError("wrong_size", "image of " + sizeText(image.width, image.height) +
                                       " with a calibration for " +
                                       sizeText(info.width, info.height) +
                                       ": expected one for the image's size");
  }
  const auto& roi = info.roi;
  const bool is_part = roi.width != 0 || roi.height != 0 || roi.x_offset != 0 || roi.y_offset != 0;
  if (info.binning_x > 1 || info.binning_y > 1 || is_part) {
    throw InputError("bad_calibration",
                     "camera_info with binning or a region of interest:"
                     " expected whole images");
  }
  for (const auto* values : {&info.K[0], &info.P[0]}) {
    if (!(values[0] > 0.0) || !std::isfinite(values[0])) {
      throw InputError("bad_calibration", "focal length of " + std::to_string(values[0]) +
                                              " px: expected more than 0 px (K and P)");
    }
  }
}

/// Returns the model of both cameras. Throws InputError unless they are a rectified stereo pair:
/// for any others the library would end the process.
image_geometry::StereoCameraModel modelOf(const sensor_msgs::CameraInfo& left,
                                          const sensor_msgs::CameraInfo& right) {
  constexpr std::size_t kFx = 0;
  constexpr std::size_t kFy = 5;
  constexpr std::size_t kCy = 6;
  constexpr std::size_t kTx = 3;
  for (const std::size_t same : {kFx, kFy, kCy}) {
    if (left.P[same] != right.P[same]) {
      throw InputError("bad_calibration",
                       "P[" + std::to_string(same) + "] is " + std::to_string(left.P[same]) +
                           " of the left camera and " + std::to_string(right.P[same]) +
                           " of the right one: expected the same, from a rectified pair");
    }
  }
  if (!(right.P[kTx] < left.P[kTx])) {
    throw InputError("bad_calibration", "P[3] of the right camera is " +
                                            std::to_string(right.P[kTx]) +
                                            ": expected -focal length * baseline, less than 0");
  }
  if (left.header.frame_id != right.header.frame_id) {
    throw InputError("unknown_frame", "cameras in frames '" + left.header.frame_id + "' and '" +
                                          right.header.frame_id +
                                          "': expected both in the left camera's (REP 104)");
  }
  image_geometry::StereoCameraModel model;
  model.fromCameraInfo(left, right);
  return model;
}

}  // namespace

void checkImage(const sensor_msgs::Image& image) {
  const auto pixel_size = kPixelSizes.find(image.encoding);
  if (pixel_size == kPixelSizes.end()) {
    throw InputError("bad_encoding",
                     "image of encoding '" + image.encoding + "': expected mono8, rgb8 or bgr8");
  }
  const std::size_t row = pixel_size->second * image.width;
  if (image.width == 0 || image.height == 0 || image.step < row ||
      image.data.size() != static_cast<std::size_t>(image.step) * image.height) {
    throw InputError("wrong_size", "image of " + sizeText(image.width, image.height) + " with " +
                                       std::to_string(image.data.size()) + " bytes in rows of " +
                                       std::to_string(image.step) + ": expected rows of " +
                                       std::to_string(row) + " bytes or more, and all of them");
  }
}

image_geometry::StereoCameraModel stereoModel(const StereoPair& pair) {
  const sensor_msgs::Image& left = *pair.left.image;
  const sensor_msgs::Image& right = *pair.right.image;
  checkInfo(*pair.left.info, left);
  checkInfo(*pair.right.info, right);
  if (left.width != right.width || left.height != right.height) {
    throw InputError("wrong_size",
                     "left image of " + sizeText(left.width, left.height) + " and right image of " +
                         sizeText(right.width, right.height) + ": expected the same size");
  }
  return modelOf(*pair.left.info, *pair.right.info);
}

cv::Mat rectifiedImage(const sensor_msgs::ImageConstPtr& image, const std::string& encoding,
                       const image_geometry::PinholeCameraModel& camera, bool already) {
  const cv::Mat pixels = cv_bridge::toCvShare(image, encoding)->image;
  if (already) {
    return pixels;
  }
  cv::Mat result;
  camera.rectifyImage(pixels, result, cv::INTER_LINEAR);
  return result;
}

}  // namespace datmo
