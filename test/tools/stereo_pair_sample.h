// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <boost/make_shared.hpp>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

/// A wall of random texture, straight ahead, as two cameras see it.
struct StereoPairSample {
  int width = 160;              ///< px
  int height = 120;             ///< px
  int disparity = 8;            ///< px, of the whole wall
  double focal_length = 200.0;  ///< px
  double baseline = 0.5;        ///< m
  std::string frame = "camera";

  double depth() const { return focal_length * baseline / disparity; }

  /// Gray, or the same in three channels. The right camera sees everything further to the left.
  sensor_msgs::ImagePtr image(Stamp stamp, bool right, const std::string& encoding) const {
    const int channels = encoding == "mono8" ? 1 : 3;
    auto image = boost::make_shared<sensor_msgs::Image>();
    image->header.stamp = toTime(stamp);
    image->header.frame_id = frame;
    image->encoding = encoding;
    image->width = static_cast<std::uint32_t>(width);
    image->height = static_cast<std::uint32_t>(height);
    image->step = static_cast<std::uint32_t>(width * channels);
    const int shift = right ? disparity : 0;
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        image->data.insert(image->data.end(), static_cast<std::size_t>(channels),
                           texture(row, column + shift));
      }
    }
    return image;
  }

  sensor_msgs::CameraInfoPtr info(Stamp stamp, bool right) const {
    auto info = boost::make_shared<sensor_msgs::CameraInfo>();
    info->header.stamp = toTime(stamp);
    info->header.frame_id = frame;
    info->width = static_cast<std::uint32_t>(width);
    info->height = static_cast<std::uint32_t>(height);
    info->distortion_model = "plumb_bob";
    info->D.assign(5, 0.0);
    const double middle_x = 0.5 * width;
    const double middle_y = 0.5 * height;
    const double shift = right ? -focal_length * baseline : 0.0;
    info->K = {focal_length, 0.0, middle_x, 0.0, focal_length, middle_y, 0.0, 0.0, 1.0};
    info->R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    info->P = {focal_length, 0.0, middle_x, shift, 0.0, focal_length,
               middle_y,     0.0, 0.0,      0.0,   1.0, 0.0};
    return info;
  }

 private:
  /// The same value for the same point of the wall.
  static std::uint8_t texture(int row, int column) {
    constexpr int kRowSeed = 10007;  // prime, more than any column
    std::minstd_rand random(static_cast<std::uint_fast32_t>(1 + row * kRowSeed + column));
    random.discard(3);
    return static_cast<std::uint8_t>(random() % 256U);
  }
};

}  // namespace datmo
