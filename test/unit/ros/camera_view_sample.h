// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "camera_samples.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/display/camera_view.h"

namespace datmo::camera_view_test {

inline constexpr std::uint32_t kWidth = 640;
inline constexpr std::uint32_t kHeight = 480;
inline constexpr double kFocalLength = 400.0;     // px
inline constexpr double kHeightOverGround = 1.5;  // m
inline constexpr std::uint8_t kGray = 60;
inline constexpr double kStart = 100.0;  // s
inline constexpr samples::CameraSample kCamera{kWidth, kHeight, kFocalLength};

inline sensor_msgs::CameraInfo cameraInfo() { return kCamera.info(); }

inline sensor_msgs::ImagePtr image(double seconds) {
  return boost::make_shared<sensor_msgs::Image>(kCamera.image(seconds, kGray));
}

/// A vehicle `ahead` of the map's origin that drives away at `speed`.
inline TrackArrayPtr tracks(double seconds, double ahead, double speed) {
  auto message = boost::make_shared<TrackArray>();
  message->header.frame_id = "map";
  message->header.stamp = ros::Time(seconds);
  TrackMessage track;
  track.id = 7;
  track.pose = toMessage(Pose2(ahead, 0.0, 0.0));
  track.size.x = 4.0;
  track.size.y = 2.0;
  track.size.z = 1.5;
  track.velocity.x = speed;
  track.moving = speed != 0.0;
  track.classification = ObjectMessage::CLASS_VEHICLE;
  message->tracks.push_back(track);
  return message;
}

class CameraViewTest : public testing::Test {
 protected:
  /// The camera at the map's origin, above the ground, faces along x.
  void mountCamera(double seconds) {
    transforms_.add(samples::transforms({samples::cameraMount("map", kHeightOverGround, seconds)}));
  }

  sensor_msgs::ImagePtr show(const sensor_msgs::ImagePtr& message, double waited = 0.0) {
    const double seconds = message->header.stamp.toSec();
    view_.handleImage(message, Stamp::fromSeconds(seconds));
    return view_.next(Stamp::fromSeconds(seconds + waited));
  }

  /// Returns whether a pixel has been drawn over.
  static bool isDrawn(const sensor_msgs::Image& picture, int column, int row) {
    const std::size_t at =
        static_cast<std::size_t>(row) * picture.step + 3 * static_cast<std::size_t>(column);
    return picture.data[at] != kGray || picture.data[at + 1] != kGray ||
           picture.data[at + 2] != kGray;
  }

  static bool anyDrawn(const sensor_msgs::Image& picture) {
    for (int row = 0; row < static_cast<int>(picture.height); ++row) {
      for (int column = 0; column < static_cast<int>(picture.width); ++column) {
        if (isDrawn(picture, column, row)) {
          return true;
        }
      }
    }
    return false;
  }

  TransformBuffer transforms_{1.0};
  StageMonitor monitor_{"camera_view"};
  CameraView view_{CameraViewOptions(), transforms_, monitor_};
};

}  // namespace datmo::camera_view_test
