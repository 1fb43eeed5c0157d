// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include <opencv2/core.hpp>

#include "datmo_fusion/vision/image_region.h"

namespace datmo {

/// Throws std::invalid_argument for an image that no detector accepts: empty, not 8 bit, neither
/// gray nor BGR.
inline void checkImage(const cv::Mat& image) {
  if (image.empty() || (image.type() != CV_8UC1 && image.type() != CV_8UC3)) {
    throw std::invalid_argument("image of " + std::to_string(image.cols) + " x " +
                                std::to_string(image.rows) + " px, OpenCV type " +
                                std::to_string(image.type()) +
                                ": expected a gray or BGR image of 8 bit that is not empty");
  }
}

/// Throws std::invalid_argument for an image that does not have the camera's size.
inline void checkSize(const cv::Mat& image, const MountedCamera& camera) {
  if (image.cols != std::lround(camera.width) || image.rows != std::lround(camera.height)) {
    throw std::invalid_argument("image of " + std::to_string(image.cols) + " x " +
                                std::to_string(image.rows) + " px: expected that of the camera, " +
                                std::to_string(std::lround(camera.width)) + " x " +
                                std::to_string(std::lround(camera.height)) + " px");
  }
}

}  // namespace datmo
