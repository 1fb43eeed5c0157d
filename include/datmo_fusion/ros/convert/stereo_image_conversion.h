// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <image_geometry/stereo_camera_model.h>
#include <opencv2/core/mat.hpp>

#include <sensor_msgs/Image.h>

#include "datmo_fusion/ros/stage/stereo_pairs.h"

namespace datmo {

/// Throws InputError (`bad_encoding`, `wrong_size`) unless an image is mono8, rgb8 or bgr8 with all
/// of its bytes.
void checkImage(const sensor_msgs::Image& image);

/// The two cameras of a pair as one. Throws InputError (`wrong_size`, `bad_calibration`,
/// `unknown_frame`) unless images and calibrations are those of a stereo pair.
image_geometry::StereoCameraModel stereoModel(const StereoPair& pair);

/// An image that checkImage accepts, in this encoding (empty: its own), rectified if it is not
/// `already`; its bytes may be the message's.
cv::Mat rectifiedImage(const sensor_msgs::ImageConstPtr& image, const std::string& encoding,
                       const image_geometry::PinholeCameraModel& camera, bool already);

}  // namespace datmo
