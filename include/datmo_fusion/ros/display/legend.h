// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/Image.h>

namespace datmo {

/// What the shapes, colors and lines of the markers stand for, as an rgb8 image for a person.
sensor_msgs::ImagePtr drawLegend();

}  // namespace datmo
