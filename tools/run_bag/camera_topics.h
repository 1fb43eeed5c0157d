// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "arguments.h"
#include "input_topics.h"

#include <rosbag/bag.h>

namespace datmo {

/// The left camera's rectified images and their info. Throws std::runtime_error if one is missing.
MonoTopics monoTopics(const rosbag::Bag& bag, const Arguments& arguments);

/// Whether the bag has the stereo camera's clouds, or the images to compute them.
bool holdsPoints(const rosbag::Bag& bag, const Arguments& arguments);

/// The stereo camera's clouds, or the images to compute them. `fusion`: section of the stage that
/// needs them. Throws std::runtime_error if the bag has neither.
StereoTopics neededStereoTopics(const rosbag::Bag& bag, const Arguments& arguments,
                                const std::string& fusion);

}  // namespace datmo
