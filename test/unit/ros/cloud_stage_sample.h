// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lidar_messages.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/stage_monitor.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo::samples {

/// A stage that subscribes to the clouds of a lidar on flat ground, with a wall 10.5 m ahead.
template <typename Stage>
class CloudStageTest : public testing::Test {
 protected:
  CloudStageTest() {
    maker_.addGround();
    maker_.addWall(10.5);
  }

  /// 0.5 m ahead of the vehicle's origin, 1.7 m above it.
  void mountLidar() {
    tf2_msgs::TFMessage message;
    message.transforms = {transform("base_link", "velodyne", 0.5)};
    message.transforms[0].transform.translation.z = kLidarHeight;
    buffer_.addStatic(message);
  }

  sensor_msgs::PointCloud2 cloudAt(double seconds) const {
    auto message = lidarMessage(maker_.cloud);
    message.header.stamp = ros::Time(seconds);
    return message;
  }

  LidarCloudMaker maker_;
  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"cloud_stage"};
  Stage stage_{typename Stage::Options(), buffer_, monitor_};
};

}  // namespace datmo::samples
