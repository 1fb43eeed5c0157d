// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "input_topics.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "datmo_fusion/ros/stage/stage_monitor.h"
#include "datmo_fusion/ros/stage/stereo_pairs.h"

namespace datmo {

/// Reads the stereo camera's images from a bag of its own, as pairs, in the order in which the bag
/// completes them. Messages that cannot be read are left out. Not thread safe.
class StereoPairReader {
 public:
  /// `tolerance`: as StereoPairs. Throws what rosbag throws.
  StereoPairReader(const std::string& bag, const StereoTopics& topics, double tolerance);

  /// None at the end of the bag.
  std::optional<StereoPair> next();

 private:
  using Handle = std::function<std::optional<StereoPair>(const rosbag::MessageInstance& message)>;

  template <typename Message>
  boost::shared_ptr<const Message> plain(const rosbag::MessageInstance& message);

  rosbag::Bag bag_;
  rosbag::View view_;
  rosbag::View::iterator message_;
  StereoPairs pairs_;
  StageMonitor unread_{"stereo_pair_reader"};  ///< the stages report the same faults
  std::map<std::string, Handle> handles_;      ///< by topic
};

}  // namespace datmo
