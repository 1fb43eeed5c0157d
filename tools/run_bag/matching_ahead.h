// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "input_topics.h"
#include "stereo_images_options.h"
#include "stereo_matcher.h"
#include "stereo_pair_reader.h"
#include <boost/asio/thread_pool.hpp>

namespace datmo {

/// Reads and matches the images of a bag in threads of its own, before the stages need the clouds.
/// A cloud depends on its pair alone, and is used only for a pair with the same content: the
/// results are those of a StereoMatcher, bit for bit.
class MatchingAhead {
 public:
  /// `threads`: 1 or more that match, besides one that reads. As many pairs are in memory, and a
  /// few more. Throws what rosbag throws.
  MatchingAhead(const std::string& bag, const StereoTopics& topics,
                const StereoImagesOptions& options, std::size_t threads);
  /// Waits for the pairs that are being matched.
  ~MatchingAhead();
  MatchingAhead(const MatchingAhead&) = delete;
  MatchingAhead& operator=(const MatchingAhead&) = delete;

  /// As StereoMatcher. Call it in the order of the bag, always from the same thread; pairs may be
  /// left out.
  sensor_msgs::PointCloud2Ptr cloudOf(const StereoPair& pair);

  /// Number of clouds returned that had been started ahead.
  std::size_t usedCount() const { return used_; }

 private:
  using Task = std::packaged_task<sensor_msgs::PointCloud2Ptr()>;

  /// A pair and its cloud. It is not matched any more when nobody has the task.
  struct Ahead {
    StereoPair pair;
    std::shared_ptr<Task> task;
    std::future<sensor_msgs::PointCloud2Ptr> cloud;
  };

  /// The work of a thread, until the end of the bag or the destructor.
  void read();
  void readPairs();
  Ahead started(const StereoPair& pair);

  /// The cloud of this pair, and forgets the pairs before it; none if it was not read ahead.
  std::optional<Ahead> find(const StereoPair& pair);

  StereoImagesOptions options_;
  std::size_t max_ahead_;
  StereoPairReader reader_;
  std::size_t used_ = 0;
  StereoMatcher matcher_;  ///< for pairs that were not read ahead

  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  std::deque<Ahead> ahead_;     ///< in the order of the bag
  std::optional<Stamp> asked_;  ///< of the last pair that was asked for
  /// Since stamps were set back: those after this one were before that, and nobody asks for them.
  std::optional<Stamp> left_out_after_;
  bool all_read_ = false;
  std::atomic<bool> stopping_{false};

  boost::asio::thread_pool matching_;
  std::thread reading_;  ///< last: it uses all others
};

}  // namespace datmo
