// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "input_topics.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "datmo_fusion/ros/stage/stereo_pairs.h"

namespace datmo {

/// Reads the stereo camera's images from a bag of its own, as pairs, in the order in which the bag
/// completes them. Messages that cannot be read are left out. Not thread safe.
class StereoPairReader {
 public:
  /// `tolerance`: as StereoPairs. Throws what rosbag throws.
  StereoPairReader(const std::string& bag, const StereoTopics& topics, double tolerance);

  /// None at the end of the bag, or when `stop` is set meanwhile.
  std::optional<StereoPair> next(const std::atomic<bool>& stop);

 private:
  using Handle = std::function<std::optional<StereoPair>(const rosbag::MessageInstance& message)>;

  /// Forgets all images if the clock was set back, as StageRunner::check().
  void checkClock(const ros::Time& time);

  rosbag::Bag bag_;
  rosbag::View view_;
  rosbag::View::iterator message_;
  StereoPairs pairs_;
  std::optional<Stamp> last_;
  std::map<std::string, Handle> handles_;  ///< by topic
};

}  // namespace datmo
