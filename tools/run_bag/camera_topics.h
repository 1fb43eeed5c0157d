// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "arguments.h"
#include "input_topics.h"

#include <rosbag/bag.h>

namespace datmo {

/// The left camera's rectified images and their info. Throws std::runtime_error for one that is not
/// there.
MonoTopics monoTopics(const rosbag::Bag& bag, const Arguments& arguments);

/// Whether the bag holds the stereo camera's clouds, or what they are made of.
bool holdsPoints(const rosbag::Bag& bag, const Arguments& arguments);

/// The stereo camera's clouds, or the images that they are made of. `fusion`: the section of the
/// stage that wants them. Throws std::runtime_error if the bag has neither.
StereoTopics neededStereoTopics(const rosbag::Bag& bag, const Arguments& arguments,
                                const std::string& fusion);

}  // namespace datmo
