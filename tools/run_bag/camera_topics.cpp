// SPDX-License-Identifier: BSD-3-Clause
#include "camera_topics.h"

#include "input_bag.h"

namespace datmo {

namespace {

const std::string kRectifiedName = "image_rect";

/// A camera's info is in the namespace of its images (image_transport).
std::string infoBeside(const std::string& image) {
  return image.substr(0, image.find_last_of('/')) + "/camera_info";
}

/// Under the stereo camera's namespace: rectified images, or raw ones where there are none.
std::string imageTopic(const rosbag::Bag& bag, const Arguments& arguments,
                       const std::string& side) {
  const std::string rectified = "/stereo/" + side + "/image_rect";
  const std::string raw = "/stereo/" + side + "/image_raw";
  return arguments.inputTopic(side + "_image", holdsTopic(bag, rectified) ? rectified : raw);
}

StereoTopics imageTopics(const rosbag::Bag& bag, const Arguments& arguments) {
  StereoTopics topics;
  topics.left_image = imageTopic(bag, arguments, "left");
  topics.right_image = imageTopic(bag, arguments, "right");
  topics.left_info = arguments.inputTopic("left_camera_info", infoBeside(topics.left_image));
  topics.right_info = arguments.inputTopic("right_camera_info", infoBeside(topics.right_image));
  return topics;
}

std::string pointsTopic(const Arguments& arguments) {
  return arguments.inputTopic("points2", "/stereo/points2");
}

/// The clouds; if there are none, or on demand, the images, whether or not they exist.
StereoTopics stereoTopics(const rosbag::Bag& bag, const Arguments& arguments) {
  StereoTopics topics = imageTopics(bag, arguments);
  const std::string points = pointsTopic(arguments);
  if (!arguments.stereo_from_images && holdsTopic(bag, points)) {
    StereoTopics cloud;
    cloud.points = points;
    cloud.velocities = arguments.inputTopic("point_velocities", "/stereo/point_velocities");
    cloud.right_info = topics.right_info;
    return cloud;
  }
  return topics;
}

/// The first of the images and their infos that is missing in the bag; empty if it has all, or
/// clouds.
std::string missingTopic(const rosbag::Bag& bag, const StereoTopics& topics) {
  if (!topics.points.empty()) {
    return "";
  }
  for (const std::string& topic :
       {topics.left_image, topics.right_image, topics.left_info, topics.right_info}) {
    if (!holdsTopic(bag, topic)) {
      return topic;
    }
  }
  return "";
}

}  // namespace

MonoTopics monoTopics(const rosbag::Bag& bag, const Arguments& arguments) {
  MonoTopics topics;
  topics.image = arguments.inputTopic("left_image", "/stereo/left/" + kRectifiedName);
  topics.info = arguments.inputTopic("left_camera_info", infoBeside(topics.image));
  for (const std::string& topic : {topics.image, topics.info}) {
    if (!holdsTopic(bag, topic)) {
      failForTopic(bag, "no " + topic +
                            " for --mono, which needs a camera's rectified images and " +
                            "their camera_info (left_image:=TOPIC, left_camera_info:=TOPIC)");
    }
  }
  return topics;
}

bool holdsPoints(const rosbag::Bag& bag, const Arguments& arguments) {
  return missingTopic(bag, stereoTopics(bag, arguments)).empty();
}

StereoTopics neededStereoTopics(const rosbag::Bag& bag, const Arguments& arguments,
                                const std::string& fusion) {
  StereoTopics topics = stereoTopics(bag, arguments);
  const std::string missing = missingTopic(bag, topics);
  if (!missing.empty()) {
    failForTopic(bag, "neither a PointCloud2 on " + pointsTopic(arguments) + " nor, for images, " +
                          missing + " (without a stereo camera, set " + fusion +
                          "/sources/stereo/use to false in " + arguments.config + ")");
  }
  return topics;
}

StereoPoints StereoTopics::input() const {
  if (left_image.empty()) {
    return StereoPoints::kClouds;
  }
  const std::string name = left_image.substr(left_image.find_last_of('/') + 1);
  return name.rfind(kRectifiedName, 0) == 0 ? StereoPoints::kRectifiedImages
                                            : StereoPoints::kRawImages;
}

}  // namespace datmo
