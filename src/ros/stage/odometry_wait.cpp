// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/odometry_wait.h"

#include <cmath>
#include <utility>

namespace datmo {

namespace {

/// One second of a fast scanner, the longest wait.
constexpr std::size_t kMaxWaiting = 50;

}  // namespace

void OdometryWait::add(Stamp scan, Stamp now, std::function<void()> serve) {
  waiting_.push_back({scan, now, std::move(serve)});
}

bool OdometryWait::serveNext(Stamp now) {
  if (waiting_.empty() || !(waiting_.size() > kMaxWaiting || mayGoOn(waiting_.front(), now))) {
    return false;
  }
  const Waiting first = std::move(waiting_.front());
  waiting_.pop_front();
  first.serve();
  return true;
}

bool OdometryWait::mayGoOn(const Waiting& waiting, Stamp now) const {
  // A clock that was set back also ends the wait.
  const bool waited = std::abs(secondsBetween(waiting.since, now)) >= max_wait_;
  const OdometrySample* newest = odometry_.newest();
  if (waited || newest == nullptr) {
    return true;
  }
  const double missing = secondsBetween(newest->stamp, waiting.scan);
  return missing <= 0.0 || missing < odometry_.period() || missing > hold_;
}

}  // namespace datmo
