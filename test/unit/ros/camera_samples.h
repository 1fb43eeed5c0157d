// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "message_samples.h"

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

/// Messages of a camera without distortion, in the frame `camera`, facing along its parent's x.
namespace datmo::samples {

struct CameraSample {
  std::uint32_t width = 0;    ///< px
  std::uint32_t height = 0;   ///< px
  double focal_length = 0.0;  ///< px; the optical axis is in the image's middle

  sensor_msgs::CameraInfo info(double seconds = 0.0) const {
    const double u = 0.5 * width;
    const double v = 0.5 * height;
    sensor_msgs::CameraInfo message;
    message.header.frame_id = "camera";
    message.header.stamp = ros::Time(seconds);
    message.width = width;
    message.height = height;
    message.K = {focal_length, 0.0, u, 0.0, focal_length, v, 0.0, 0.0, 1.0};
    message.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    message.P = {focal_length, 0.0, u, 0.0, 0.0, focal_length, v, 0.0, 0.0, 0.0, 1.0, 0.0};
    return message;
  }

  sensor_msgs::Image image(double seconds, std::uint8_t gray) const {
    sensor_msgs::Image message;
    message.header.frame_id = "camera";
    message.header.stamp = ros::Time(seconds);
    message.encoding = "mono8";
    message.width = width;
    message.height = height;
    message.step = width;
    message.data.assign(std::size_t{width} * height, gray);
    return message;
  }

  /// A bright sky above a dark road, with a sensor's noise; `number`, the first pixel, makes images
  /// differ.
  sensor_msgs::Image road(double seconds, std::uint8_t number) const {
    constexpr std::uint8_t kRoad = 110;
    constexpr std::uint8_t kSky = 220;
    sensor_msgs::Image message = image(seconds, kRoad);
    const std::size_t horizon = message.data.size() / 2;
    for (std::size_t i = 0; i < message.data.size(); ++i) {
      message.data[i] = static_cast<std::uint8_t>((i < horizon ? kSky : kRoad) + i % 3);
    }
    message.data.front() = number;
    return message;
  }
};

/// From `parent` to the camera, at this height (m) above its origin.
inline geometry_msgs::TransformStamped cameraMount(const std::string& parent, double height,
                                                   double seconds = 0.0) {
  geometry_msgs::TransformStamped mount = transform(parent, "camera", 0.0, seconds);
  mount.transform.translation.z = height;
  mount.transform.rotation.x = -0.5;
  mount.transform.rotation.y = 0.5;
  mount.transform.rotation.z = -0.5;
  mount.transform.rotation.w = 0.5;
  return mount;
}

}  // namespace datmo::samples
