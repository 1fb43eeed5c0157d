// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <image_geometry/stereo_camera_model.h>
#include <opencv2/core/mat.hpp>

#include <sensor_msgs/Image.h>

#include "datmo_fusion/ros/stage/stereo_pairs.h"

namespace datmo {

/// Throws InputError (`bad_encoding`, `wrong_size`) unless the image is mono8, rgb8 or bgr8 and
/// complete.
void checkImage(const sensor_msgs::Image& image);

/// Returns the camera model of a pair. Throws InputError (`wrong_size`, `bad_calibration`,
/// `unknown_frame`) unless images and calibrations belong to a stereo pair.
image_geometry::StereoCameraModel stereoModel(const StereoPair& pair);

/// Converts an image that checkImage accepts to this encoding (empty: its own), and rectifies it
/// unless `already`; the result may share the message's data.
cv::Mat rectifiedImage(const sensor_msgs::ImageConstPtr& image, const std::string& encoding,
                       const image_geometry::PinholeCameraModel& camera, bool already);

}  // namespace datmo
