// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cv_bridge/cv_bridge.h>

#include <sensor_msgs/Image.h>

namespace datmo {

/// The pixels as bgr8, a copy to draw on. Throws InputError (`bad_encoding`): also where pixels are
/// missing.
cv_bridge::CvImagePtr colorCopy(const sensor_msgs::Image& image);

/// The pixels as mono8 where they are gray, else as bgr8, without a copy where they are that
/// already. Throws as colorCopy.
cv_bridge::CvImageConstPtr grayOrColor(const sensor_msgs::ImageConstPtr& image);

}  // namespace datmo
