// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Image.h>

namespace datmo {

/// Draws a legend of the markers' shapes, colors and lines as an rgb8 image.
sensor_msgs::ImagePtr drawLegend();

}  // namespace datmo
