// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_pair_reader.h"

#include <vector>

#include "input_bag.h"

#include "datmo_fusion/ros/frame_ids.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

/// Decodes a message, with frames as the stages get them.
template <typename Message>
boost::shared_ptr<const Message> plain(const rosbag::MessageInstance& message) {
  const boost::shared_ptr<Message> content = read<Message>(message);
  stripSlashes(*content);
  return content;
}

}  // namespace

StereoPairReader::StereoPairReader(const std::string& bag, const StereoTopics& topics,
                                   double tolerance)
    : pairs_(tolerance) {
  const auto add = [this](StereoSide side, const std::string& image, const std::string& info) {
    handles_[image] = [this, side](const rosbag::MessageInstance& message) {
      const auto content = plain<sensor_msgs::Image>(message);
      checkClock(content->header.stamp);
      return pairs_.handleImage(side, content);
    };
    handles_[info] = [this, side](const rosbag::MessageInstance& message) {
      const auto content = plain<sensor_msgs::CameraInfo>(message);
      checkClock(content->header.stamp);
      return pairs_.handleInfo(side, content);
    };
  };
  add(StereoSide::kLeft, topics.left_image, topics.left_info);
  add(StereoSide::kRight, topics.right_image, topics.right_info);
  bag_.open(bag, rosbag::bagmode::Read);
  view_.addQuery(
      bag_, rosbag::TopicQuery(std::vector<std::string>{topics.left_image, topics.left_info,
                                                        topics.right_image, topics.right_info}));
  message_ = view_.begin();
}

std::optional<StereoPair> StereoPairReader::next(const std::atomic<bool>& stop) {
  std::optional<StereoPair> pair;
  while (!pair && !stop && message_ != view_.end()) {
    const rosbag::MessageInstance message = *message_++;
    try {
      pair = handles_.at(message.getTopic())(message);
    } catch (const InputError&) {  // reported where the stages read it
    }
  }
  return pair;
}

void StereoPairReader::checkClock(const ros::Time& time) {
  const Stamp stamp = toStamp(time);
  if (last_ && secondsBetween(stamp, *last_) > StreamOptions().restart_after) {
    pairs_.clear();
  }
  last_ = stamp;
}

}  // namespace datmo
