// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/decode_errors.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace datmo {

namespace {

/// Maximum number of errors that wait for a subscription whose callback takes long: a second of the
/// fastest sensors. Further ones are only counted.
constexpr std::size_t kMaxWaiting = 1000;

/// All subscriptions of the process.
struct Subscribers {
  std::mutex mutex;
  std::vector<DecodeErrors*> all;
};

Subscribers& subscribers() {
  static Subscribers instance;
  return instance;
}

}  // namespace

DecodeErrors::DecodeErrors(ros::CallbackQueueInterface& queue, InputTopic topic, Callback callback)
    : topic_(std::move(topic)),
      callback_(std::move(callback)),
      poster_(queue, [this] { deliver(); }) {
  Subscribers& others = subscribers();
  const std::lock_guard<std::mutex> lock(others.mutex);
  others.all.push_back(this);
}

DecodeErrors::~DecodeErrors() {
  Subscribers& others = subscribers();
  const std::lock_guard<std::mutex> lock(others.mutex);
  others.all.erase(std::remove(others.all.begin(), others.all.end(), this), others.all.end());
}

void DecodeErrors::deliver() {
  std::vector<DecodeError> errors;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    errors.swap(waiting_);
  }
  for (const DecodeError& error : errors) {
    callback_(error);
  }
}

void DecodeErrors::report(const InputTopic& topic, const DecodeError& error) {
  Subscribers& others = subscribers();
  const std::lock_guard<std::mutex> lock(others.mutex);
  for (DecodeErrors* const each : others.all) {
    if (each->topic_.topic == topic.topic && each->topic_.data_type == topic.data_type) {
      each->put(error);
    }
  }
}

void DecodeErrors::put(const DecodeError& error) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (waiting_.size() >= kMaxWaiting) {
    waiting_.back().count += error.count;
    return;
  }
  waiting_.push_back(error);
  if (waiting_.size() == 1) {
    poster_.post();  // that call takes all that follow until then, too
  }
}

}  // namespace datmo
