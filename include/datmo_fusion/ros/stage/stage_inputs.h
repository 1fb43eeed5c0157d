// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/motion_options.h"
#include "datmo_fusion/ros/stage/clock_check.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stereo_pairs.h"

namespace datmo {

/// Declares the motion input of a stage with handleOdometry and handlePose: odometry, or the SLAM
/// poses if no input has the speed.
template <typename MovingStage>
void connectMotion(StagePorts& ports, const MotionOptions& motion, MovingStage& stage) {
  if (motion.hasSpeed()) {
    ports.in<nav_msgs::Odometry>(
        motion.odometryTopic(),
        [&stage](const auto& odometry, Stamp /*now*/) { stage.handleOdometry(*odometry); });
  } else {
    ports.in<geometry_msgs::PoseWithCovarianceStamped>(
        "pose/local", [&stage](const auto& pose, Stamp /*now*/) { stage.handlePose(*pose); });
  }
}

/// Declares the scanner input, with one or several echoes, behind a check of its clock. `callback`:
/// called as (scan, Stamp now), for either type; `monitor` must outlive the ports.
template <typename Callback>
void connectScan(StagePorts& ports, StageMonitor& monitor, const Callback& callback) {
  using OneEcho = sensor_msgs::LaserScan;
  using Echoes = sensor_msgs::MultiEchoLaserScan;
  ports.in<OneEcho>("scan", withClockCheck<OneEcho>(ports, "scan", monitor, callback));
  ports.inInsteadOf<Echoes>("scan", "echoes",
                            withClockCheck<Echoes>(ports, "scan", monitor, callback));
}

/// Declares the stereo camera for a stage with handleCameraInfo and handleCloud, whose result goes
/// to `output`.
template <typename StereoStage, typename Message>
void connectStereo(StagePorts& ports, StereoStage& stage, const StagePublisher<Message>& output) {
  ports.optionalIn<sensor_msgs::CameraInfo>(
      "right/camera_info",
      [&stage](const auto& info, Stamp /*now*/) { stage.handleCameraInfo(*info); });
  ports.in<sensor_msgs::PointCloud2>("points2", [&stage, output](const auto& cloud, Stamp /*now*/) {
    output.publish(stage.handleCloud(*cloud));
  });
}

/// Declares the alignment of the camera's clouds with the scanner's points, for a stage with
/// handleAlignment; to be declared before its clouds.
template <typename StereoStage>
void connectAlignment(StagePorts& ports, StereoStage& stage) {
  ports.optionalIn<StereoAlignmentMessage>(
      "stereo/alignment",
      [&stage](const auto& alignment, Stamp /*now*/) { stage.handleAlignment(*alignment); });
}

/// Declares the images of a stereo camera, for a stage with handleImage and handleInfo, whose
/// result goes to `output`.
template <typename ImageStage>
void connectImages(StagePorts& ports, ImageStage& stage,
                   const StagePublisher<sensor_msgs::PointCloud2>& output) {
  for (const auto& [side, name] : {std::pair<StereoSide, std::string>(StereoSide::kLeft, "left/"),
                                   {StereoSide::kRight, "right/"}}) {
    ports.in<sensor_msgs::CameraInfo>(name + "camera_info",
                                      [&stage, output, side = side](const auto& info, Stamp) {
                                        output.publish(stage.handleInfo(side, info));
                                      });
    ports.in<sensor_msgs::Image>(name + "image",
                                 [&stage, output, side = side](const auto& image, Stamp) {
                                   output.publish(stage.handleImage(side, image));
                                 });
  }
}

}  // namespace datmo
