// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cv_bridge/cv_bridge.h>

#include <sensor_msgs/Image.h>

namespace datmo {

/// Copies the pixels as bgr8, to draw on. Throws InputError (`bad_encoding`), also if pixels are
/// missing.
cv_bridge::CvImagePtr colorCopy(const sensor_msgs::Image& image);

/// Returns the pixels as mono8 if they are gray, else as bgr8, without a copy if they already have
/// that encoding. Throws like colorCopy.
cv_bridge::CvImageConstPtr grayOrColor(const sensor_msgs::ImageConstPtr& image);

}  // namespace datmo
