// SPDX-License-Identifier: BSD-3-Clause
#include "matching_ahead.h"

#include <algorithm>
#include <utility>

#include <boost/asio/post.hpp>

namespace datmo {

namespace {

bool isSame(const CameraFrame& one, const CameraFrame& other) {
  return one.stamp == other.stamp && *one.info == *other.info && *one.image == *other.image;
}

bool isSame(const StereoPair& one, const StereoPair& other) {
  return isSame(one.left, other.left) && isSame(one.right, other.right);
}

}  // namespace

MatchingAhead::MatchingAhead(const std::string& bag, const StereoTopics& topics,
                             const StereoImagesOptions& options, std::size_t threads)
    : options_(options),
      max_ahead_(threads + 1),  // one more, so that no thread waits for the reader
      reader_(bag, topics, options.sync.pairTolerance()),
      matcher_(options),
      matching_(threads),
      reading_([this] { read(); }) {}

MatchingAhead::~MatchingAhead() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  reading_.join();
  matching_.stop();
  matching_.join();
}

void MatchingAhead::read() {
  try {
    readPairs();
  } catch (const std::exception&) {
    // From rosbag. The bag is read once more for the stages, where the same fault is reported.
  }
  const std::lock_guard lock(mutex_);
  all_read_ = true;
  changed_.notify_all();
}

void MatchingAhead::readPairs() {
  while (const std::optional<StereoPair> pair = reader_.next(stopping_)) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || ahead_.size() < max_ahead_; });
    if (stopping_) {
      return;
    }
    ahead_.push_back(started(*pair));
    changed_.notify_all();
  }
}

MatchingAhead::Ahead MatchingAhead::started(const StereoPair& pair) {
  // A matcher for each pair, as one cannot be shared by threads: making it costs little.
  const auto task = std::make_shared<Task>(
      [options = options_, pair] { return StereoMatcher(options).cloudOf(pair); });
  Ahead ahead{pair, task, task->get_future()};
  boost::asio::post(matching_, [waiting = std::weak_ptr<Task>(task)] {
    if (const std::shared_ptr<Task> needed = waiting.lock()) {
      (*needed)();
    }
  });
  return ahead;
}

sensor_msgs::PointCloud2Ptr MatchingAhead::cloudOf(const StereoPair& pair) {
  std::optional<Ahead> ahead = find(pair);
  if (!ahead) {
    return matcher_.cloudOf(pair);
  }
  ++used_;
  return ahead->cloud.get();
}

std::optional<MatchingAhead::Ahead> MatchingAhead::find(const StereoPair& pair) {
  std::unique_lock lock(mutex_);
  const Stamp stamp = pair.left.stamp;
  if (asked_ && stamp <= *asked_) {
    left_out_after_ = asked_;
  }
  asked_ = stamp;
  while (true) {
    const auto found = std::find_if(ahead_.begin(), ahead_.end(),
                                    [&](const Ahead& one) { return isSame(one.pair, pair); });
    if (found != ahead_.end()) {
      std::optional<Ahead> ahead = std::move(*found);
      ahead_.erase(ahead_.begin(), std::next(found));
      left_out_after_.reset();
      changed_.notify_all();
      return ahead;
    }
    const auto left_out = [&](const Ahead& one) {
      return one.pair.left.stamp < stamp ||
             (left_out_after_ && one.pair.left.stamp > *left_out_after_);
    };
    ahead_.erase(std::remove_if(ahead_.begin(), ahead_.end(), left_out), ahead_.end());
    changed_.notify_all();
    if (all_read_ || !ahead_.empty()) {
      return std::nullopt;
    }
    changed_.wait(lock, [this] { return all_read_ || !ahead_.empty(); });
  }
}

}  // namespace datmo
